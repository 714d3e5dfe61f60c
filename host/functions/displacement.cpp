#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> displacement_functions() {
    const Parameter p = vector("p", "metres", "base point"), h = number("h", "metres", "height along n");
    const Result displaced = result(vector("displaced", "metres", "p + h n"), {relative});
    const Result normal = result(direction("normal", "normal of the displaced surface"), {degrees});
    return {
        {.name = "displace",
         .file = "surface/displacement.clh",
         .summary = "The displaced point and its normal, without the curvature of the base",
         .source = "Gustavson 2021, eq. 3 to 8; Blinn 1978, eq. 2 without its last terms",
         .parameters = {p, given_normal, h, vector("dh_dp", "metres per metre, world", "gradient of the height")},
         .results = {displaced, normal},
         .variants = {{standard,
                       "displaced = wr_displace(p, n, h);\nnormal = wr_displaced_normal(n, dh_dp);",
                       {1e-7, 1e-5}}},
         .fp64_error = 2e-9,
         .note = "What is left out of the normal is about the slope times |h| / radius of curvature."},
        {.name = "displace_curved",
         .file = "surface/displacement.clh",
         .summary = "The displaced point and its normal, with the curvature of the base",
         .source = "Blinn 1978, eq. 2",
         .parameters = {p, base_normal, dp_dx, dp_dy,
                        vector("dn_dx", "per pixel, world", "change of the normal to the right"),
                        vector("dn_dy", "per pixel, world", "change of the normal downwards"), h,
                        number("dh_dx", "metres per pixel", "change of the height to the right"),
                        number("dh_dy", "metres per pixel", "change of the height downwards")},
         .results = {displaced, normal},
         .variants = {{standard,
                       "displaced = wr_displace(p, n, h);\n"
                       "normal = wr_displaced_normal_curved(n, dp_dx, dp_dy, dn_dx, dn_dy, h, dh_dx, dh_dy);",
                       {1e-7, 1e-5}}},
         .note = "Any two parameters do for x and y. n where the displaced surface has no normal."},
    };
}

}  // namespace wrinkle
