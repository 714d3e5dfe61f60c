#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> prologue_functions() {
    const Parameter interpolated = vector("n", "any length, world", "normal as interpolated, on the mesh's own side");
    return {
        {.name = "vertex_frame",
         .file = "surface/vertex_frame.clh",
         .summary =
             "Tangent and bitangent that a renderer interpolated, scaled to go with the unit normal (mikkTSpace)",
         .source = "Mikkelsen 2020, section 3.2, listing 9",
         .parameters = {interpolated, vector("tangent", "any length, world", "tangent as interpolated"),
                        number("tangent_sign", "1", "above 0: bitangent along n x tangent; else the other way round")},
         .results = {result(vector("T", "world", "tangent over the length of n"), {relative}),
                     result(vector("B", "world", "bitangent over the length of n"), {relative})},
         .variants = {{standard,
                       "wr_tangents f = wr_vertex_frame(n, tangent, tangent_sign);\nT = f.t, B = f.b;",
                       {4e-7, 4e-7}}},
         .note = "0 for n = 0. Components that a float cannot hold become 3e38."},
        {.name = "two_sided_normal",
         .file = "surface/vertex_frame.clh",
         .summary = "Base normal of a material with two sides: unit, turned over where its back is seen",
         .source = "Mikkelsen 2020, listing 9",
         .parameters = {interpolated, number("flip", "0 or 1", "1 where the back is seen")},
         .results = {result(direction("normal", "base normal"), {degrees, relative})},
         .variants = {{standard, "normal = wr_two_sided_normal(n, flip != 0);", {1e-5, 3e-7}}},
         .note = "0 for n = 0."},
        {.name = "facing_normal",
         .file = "surface/gbuffer.clh",
         .summary = "Base normal that faces away from the viewer, reflected towards the viewer",
         .source = "Mikkelsen 2020, section 3.7",
         .parameters = {base_normal, vector("p", "metres, relative to the eye", "surface point, not the eye itself")},
         .results = {result(direction("normal", "n, or n - 2 (v . n) v for v from the point to the eye"), {degrees}),
                     result(number("reflected", "0 or 1", "1 where n faced away"), {absolute})},
         .variants =
             {{standard,
               "wr_mask away;\nnormal = wr_face_viewer(n, p, &away);\nreflected = away ? (wr_real)(1) : (wr_real)(0);",
               {2e-5, 0}}}},
        {.name = "rebase",
         .file = "surface/vertex_frame.clh",
         .summary = "What depends on the base normal, anew after a resolve: tangent screen derivatives, handedness",
         .source = "Mikkelsen 2020, section 3.7, listing 9",
         .parameters = {base_normal, dp_dx, dp_dy},
         .results = {result(vector("sigma_x", "metres per pixel, world", "part of dp_dx tangent to n"), {relative}),
                     result(vector("sigma_y", "metres per pixel, world", "part of dp_dy tangent to n"), {relative}),
                     result(number("flip_sign", "1 or -1", "handedness of dp_dx, dp_dy, n"), {absolute})},
         .variants = {{standard,
                       "wr_surface_base base = wr_rebase(n, dp_dx, dp_dy);\n"
                       "sigma_x = base.sigma_x, sigma_y = base.sigma_y, flip_sign = base.flip_sign;",
                       {3e-7, 3e-7, 0}}},
         .fp64_error = 2e-9,
         .note = "Also for derivatives nearly parallel to n. 1 where dp_dx and dp_dy are parallel."},
    };
}

}  // namespace wrinkle
