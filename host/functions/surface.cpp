#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> surface_functions() {
    const Parameter p = vector("p", "metres, world, relative to the eye", "surface point");
    const Parameter x = number("x", "pixels", "pixel centre, to the right"),
                    y = number("y", "pixels", "pixel centre, downwards");
    const Setting camera{"frame", Setting::Kind::camera, "the camera that p is relative to"};
    return {
        {.name = "screen_derivatives",
         .file = "surface/screen_derivative.clh",
         .summary = "How the surface point moves from pixel to pixel, without neighbours",
         .source = "Mikkelsen 2020, listing 10, in a form without depth range",
         .parameters = {base_normal, p, x, y},
         .settings = {camera},
         .results = {result(dp_dx, {relative, degrees}), result(dp_dy, {relative, degrees})},
         .variants = {{fast,
                       "vec3 d = wr_ray(frame, x, y);\n"
                       "wr_screen_derivatives_fast(frame, n, d, wr_along_ray(p, d), x, y, &dp_dx, &dp_dy);",
                       {1e-6, 2e-5, 1e-6, 2e-5}},
                      {standard,
                       "vec3 d = wr_ray(frame, x, y);\n"
                       "wr_screen_derivatives(frame, n, d, wr_along_ray(p, d), x, y, &dp_dx, &dp_dy);",
                       {1e-6, 1e-5, 1e-6, 1e-5}},
                      {exact,
                       "real r = wr_along_ray(p, wr_ray(frame, x, y));\n"
                       "wr_screen_derivatives_exact(frame, n, r, x, y, &dp_dx, &dp_dy);",
                       {1e-6, 1e-5, 1e-6, 1e-5},
                       true}},
         .note = "A pinhole camera. Relative errors grow as 1 / |cos(n, ray)|, directions as 1 / sin(n, image axis x "
                 "ray): near a horizon."},
        {.name = "screen_derivatives_general",
         .file = "surface/screen_derivative.clh",
         .summary = "The same for any projection: parallel, oblique, any depth convention",
         .source = "Mikkelsen 2020, listing 10",
         .parameters = {base_normal, p, x, y},
         .settings = {camera},
         .results = {result(dp_dx, {relative, degrees}), result(dp_dy, {relative, degrees})},
         .variants = {{standard,
                       "wr_screen_derivatives_general(frame, n, p, x, y, &dp_dx, &dp_dy);",
                       {1e-6, 1e-5, 1e-6, 1e-5}},
                      {exact,
                       "wr_screen_derivatives_general_exact(frame, n, p, x, y, &dp_dx, &dp_dy);",
                       {1e-6, 1e-5, 1e-6, 1e-5},
                       true}},
         .note = "Relative errors grow as 1 / |cos(n, ray)|, directions as 1 / sin(n, image axis x ray)."},
        {.name = "texture_step",
         .file = "surface/texcoord_derivative.clh",
         .summary = "Change of the texture coordinates for a step in space, from the tangents dp/du and dp/dv",
         .source = "least squares of dp = du dp_du + dv dp_dv",
         .parameters = {vector("dp", "metres", "step in space"), vector("dp_du", "metres per unit u", "tangent"),
                        vector("dp_dv", "metres per unit v", "bitangent")},
         .results = {result(pair("step", "1", "change of (u, v)"), {relative}),
                     result(number("usable", "0 or 1", "0 where the tangents are parallel"), {absolute})},
         .variants = {{standard,
                       "mask any = dp.x == dp.x;\n"
                       "step = wr_texcoord_step(dp, dp_du, dp_dv, &any);\n"
                       "usable = any ? (real)(1) : (real)(0);",
                       {1e-6, 0}}},
         .note = "Skewed tangents take their share of the digits, 1 / sin^2 of their angle. Parallel ones give 0."},
        {.name = "tangent_frame",
         .file = "surface/tangent_frame.clh",
         .summary = "Tangent and bitangent of any texture coordinates, without vertex tangents",
         .source = "Mikkelsen 2020, listing 4",
         .parameters = {base_normal, dp_dx, dp_dy, dst_dx, dst_dy},
         .results = {result(direction("T", "tangent"), {degrees}), result(direction("B", "bitangent"), {degrees})},
         .variants = {{standard,
                       "wr_frame_tb f = wr_tangent_frame(n, dp_dx, dp_dy, dst_dx, dst_dy);\nT = f.t, B = f.b;",
                       {1e-5, 1e-5}}},
         .note = "Both are 0 where the texture coordinates are degenerate."},
        {.name = "surface_gradient_from_tbn",
         .file = "surface/surface_gradient.clh",
         .summary = "Surface gradient of slopes along a tangent frame; strength does not depend on the tiling",
         .source = "Mikkelsen 2020, listing 3",
         .parameters = {pair("slope", "1", "dh/du, dh/dv in the frame"), vector("T", "world", "tangent"),
                        vector("B", "world", "bitangent")},
         .results = {result(surface_gradient, {relative})},
         .variants = {{standard, "wr_frame_tb f = {T, B};\ng = wr_surface_gradient_from_tbn(slope, f);", {2e-7}}}},
        {.name = "surface_gradient_scale_dependent",
         .file = "surface/surface_gradient.clh",
         .summary = "Surface gradient of a height in metres over texture coordinates",
         .source = "Mikkelsen 2020, eq. 7, listing 6",
         .parameters = {base_normal, dp_dx, dp_dy, dst_dx, dst_dy,
                        pair("dh_dst", "metres per unit s, t", "slopes of the height")},
         .results = {result(surface_gradient, {resolved_degrees, degrees, relative})},
         .variants = {{standard,
                       "g = wr_surface_gradient_scale_dependent(n, dp_dx, dp_dy, dst_dx, dst_dy, dh_dst);",
                       {1e-5, 1e-5, 1e-6}}},
         .note = "20 times that for a normal nearly in the plane of dp_dx and dp_dy. 0 where those are parallel."},
        {.name = "surface_gradient_from_volume",
         .file = "surface/surface_gradient.clh",
         .summary = "Surface gradient of a gradient in space: its part tangent to the surface",
         .source = "Mikkelsen 2020, eq. 6, listing 8",
         .parameters = {base_normal, vector("dh_dp", "metres per metre, world", "volume gradient")},
         .results = {result(surface_gradient, {relative})},
         .variants = {{standard, "g = wr_surface_gradient_from_volume(n, dh_dp);", {3e-7}}},
         .fp64_error = 2e-9,
         .note = "Also for gradients nearly parallel to n."},
    };
}

}  // namespace wrinkle
