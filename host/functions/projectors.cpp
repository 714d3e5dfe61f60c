#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> projector_functions() {
    const Parameter p = vector("p", "metres, world, relative to the eye", "surface point");
    const Setting row{"decal", Setting::Kind::projector, "the row, in the same space"};
    const char* const near_apex = "Of cones times the square of the image's size at the base over that at the point.";
    return {
        {.name = "projector_locate",
         .file = "sources/projector.clh",
         .summary = "Where points lie in a row of a table of decals and in its image, and its fade towards the border",
         .source = "Mikkelsen 2020, section 4.5; a cone projects as a slide projector does",
         .parameters = {p},
         .settings = {row},
         .results = {result(vector("q", "half sizes", "place in the box, within +-1 inside"), {absolute}),
                     result(pair("image", "1", "place in the image, within +-1"), {absolute}),
                     result(number("size", "1", "of the image, a share of its size at the base"), {absolute}),
                     result(number("inside", "0 or 1", "whether it is in the shape"), {absolute}),
                     result(number("falloff", "1", "fade towards the border"), {absolute})},
         .variants = {{standard,
                       "wr_projected at_row = wr_project(decal, p);\n"
                       "q = at_row.q, image = at_row.image, size = at_row.size;\n"
                       "inside = at_row.inside ? (wr_real)(1) : (wr_real)(0);\n"
                       "falloff = wr_projector_falloff(decal, at_row);",
                       {1e-5, 2e-5, 1e-5, 0, 1e-4}}},
         .note = std::string("For points up to 10 half sizes from the eye. ") + near_apex},
        {.name = "projector_step",
         .file = "sources/projector.clh",
         .summary = "Change of a row's texture coordinates for a step in space",
         .source = "chain rule through the projector",
         .parameters = {p, vector("dp", "metres", "step in space")},
         .settings = {row},
         .results = {result(pair("step", "1", "change of (s, t)"), {relative})},
         .variants = {{standard, "step = wr_projector_step(decal, wr_project(decal, p), dp);", {3e-5}}},
         .note = near_apex},
        {.name = "projector_angle_fade",
         .file = "sources/projector.clh",
         .summary = "Fade of a row with the angle between a surface and the projector",
         .source = "linear in the cosine, between the two cosines of the row",
         .parameters = {base_normal},
         .settings = {row},
         .results = {result(number("fade", "1", "within [0, 1]; 0 behind, unless two-sided"), {absolute})},
         .variants = {{standard, "fade = wr_projector_angle_fade(decal, n);", {4e-6}}}},
        {.name = "projector_gradient",
         .file = "sources/projector.clh",
         .summary = "Volume gradient of a row's image",
         .source = "Mikkelsen 2020, listing 15 before its projection; chain rule through the projector",
         .parameters = {p, pair("slope", "heights per unit s, t", "of the image"),
                        number("weight", "1", "fades times mask")},
         .settings = {row},
         .results = {result(vector("dh_dp", "heights per metre, world", "volume gradient"), {relative})},
         .variants = {{standard,
                       "dh_dp = wr_projector_blend(decal, wr_project(decal, p), slope, weight, wr_zero3());",
                       {3e-5}}},
         .note = near_apex},
        {.name = "projector_bumped_axis",
         .file = "sources/projector.clh",
         .summary = "A row's own axis, bumped as if the image lay flat on the box; to compare with",
         .source = "Mikkelsen 2020, section 4.5, figure 6",
         .parameters = {p, pair("slope", "heights per unit s, t", "of the image")},
         .settings = {row},
         .results = {result(direction("normal", "the row's own normal"), {degrees})},
         .variants = {{standard, "normal = wr_projector_bumped_axis(decal, wr_project(decal, p), slope);", {1e-5}}}},
    };
}

}  // namespace wrinkle
