#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> compose_functions() {
    const Parameter offset = pair("offset", "1", "offset of the texture coordinates");
    const Parameter range = pair("range", "1", "change of the texture coordinates from height 0 to 1, along the ray");
    const Parameter st = pair("st", "1", "texture coordinates of the surface point");
    return {
        {.name = "resolve",
         .file = "compose/resolve.clh",
         .summary = "The perturbed normal, normalize(n - g)",
         .source = "Mikkelsen 2020, eq. 5, listing 1",
         .parameters = {given_normal, vector("g", "metres per metre, world", "sum of the surface gradients")},
         .results = {result(direction("normal", "perturbed normal"), {degrees})},
         .variants = {{standard, "normal = wr_resolve(n, g);", {1e-5}}},
         .note = "Gradients of any finite length. 0 for g = n."},
        {.name = "project_to_texture",
         .file = "compose/parallax.clh",
         .summary = "A direction in texture space: per metre along it, and per metre of height that it climbs",
         .source = "Mikkelsen 2020, listing 11; per metre along it as Welsh 2004",
         .parameters = {base_normal, dp_dx, dp_dy, dst_dx, dst_dy, direction("dir", "such as the one to the viewer")},
         .results = {result(pair("along", "per metre", "change of the texture coordinates along dir"), {relative}),
                     result(pair("climbing", "per metre", "along / |n . dir|"), {relative})},
         .variants = {{standard,
                       "along = wr_project_to_texture(n, dp_dx, dp_dy, dst_dx, dst_dy, dir);\n"
                       "real climb = fabs(wr_dot2(n, dir));\n"
                       "climbing = wr_scale(along, climb > 0 ? 1 / climb : (real)(0));",
                       {3e-7, 4e-7}}},
         .note = "0 where dp_dx and dp_dy are parallel; climbing is 0 too where dir lies in the surface."},
        {.name = "texture_offset_to_surface",
         .file = "compose/parallax.clh",
         .summary = "The step on the surface that an offset of the texture coordinates stands for",
         .source = "Mikkelsen 2020, listing 12",
         .parameters = {dp_dx, dp_dy, dst_dx, dst_dy, offset},
         .results = {result(vector("step", "metres, world", "step on the surface"), {relative})},
         .variants = {{standard, "step = wr_texture_offset_to_surface(dp_dx, dp_dy, dst_dx, dst_dy, offset);", {3e-7}}},
         .note = "0 where the texture coordinates are degenerate."},
        {.name = "parallax_march",
         .file = "compose/parallax.clh",
         .summary = "The height at which a ray from above first meets a height map, repeated",
         .source = "Mikkelsen 2020, 4.3; Brawley and Tatarchuk 2005",
         .parameters = {st, range, number("lod", "1", "mip level")},
         .settings = {{"heights", Setting::Kind::height_texture, "the height map"},
                      {"steps", Setting::Kind::number, "linear steps, at most", {32}},
                      {"refine", Setting::Kind::number, "refinements after them", {3}},
                      {"level", Setting::Kind::number, "the height that lies on the surface", {0}}},
         .results = {result(number("height", "1", "in [0, 1]; the coordinates there are st + range (height - level)"),
                            {absolute})},
         .variants = {{standard,
                       "real step = wr_parallax_step(heights, range, lod, (int)steps);\n"
                       "height = wr_parallax_march(heights, st, range, level, lod, step, (int)steps, (int)refine,\n"
                       "                           st.x == st.x);",
                       {1e-5}}},
         .fp64_error = 1e-6,
         .note = "Where the ray crosses the heights at a clear angle; one that grazes a peak may meet it or not."},
        {.name = "parallax_normal",
         .file = "compose/parallax.clh",
         .summary = "The base normal of a curved surface where parallax has moved the point",
         .source = "Mikkelsen 2020, 4.3",
         .parameters = {base_normal, vector("dn_dx", "per pixel, world", "change of the normal to the right"),
                        vector("dn_dy", "per pixel, world", "change of the normal downwards"),
                        pair("pixels", "pixels", "how far the point moves over the surface"),
                        vector("view", "any", "direction to the viewer")},
         .results = {result(direction("normal", "normal there"), {degrees})},
         .variants = {{standard, "normal = wr_parallax_normal(n, dn_dx, dn_dy, pixels, view);", {1e-5}}},
         .note = "n where the corrected normal would face away from the viewer."},
    };
}

}  // namespace wrinkle
