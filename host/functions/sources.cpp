#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> source_functions() {
    const Parameter st = pair("st", "1", "texture coordinates, t up"), lod = number("lod", "1", "mip level");
    const Result texel_slope = result(pair("slope", "heights per texel", "dh/ds, dh/dt"), {absolute});
    return {
        {.name = "tangent_normal_slope",
         .file = "sources/normal_map.clh",
         .summary = "Slopes of the height that a tangent-space normal stands for, within +-128",
         .source = "Mikkelsen 2020, eq. 15 and 16, listing 2",
         .parameters = {vector("m", "tangent space", "normal of any length; z may be 0 or negative")},
         .results = {result(pair("slope", "1", "dh/du, dh/dv, t up"), {relative})},
         .variants = {{standard, "slope = wr_tangent_normal_slope(m);", {2e-7}}},
         .note = "0 for m = 0."},
        {.name = "height_slope_plain",
         .file = "sources/height_map.clh",
         .summary = "Slopes of a height map by forward differences at least a texel apart, repeated",
         .source = "Mikkelsen 2020, listing 16 without its smooth path",
         .parameters = {st, lod},
         .settings = {{"heights", Setting::Kind::height_texture, "the height map"}},
         .results = {texel_slope},
         .variants = {{standard,
                       "slope = wr_height_slope_plain(heights, st, lod);\n"
                       "slope = wr_v2(slope.x / wr_texture_width(heights), slope.y / wr_texture_height(heights));",
                       {2e-5}}},
         .fp64_error = 1e-6,
         .note = "At tilings up to 1e5."},
        {.name = "height_slope_smooth",
         .file = "sources/height_map.clh",
         .summary = "Slopes of a height map by Sobel operators, interpolated: no facets when magnified; repeated",
         .source = "Mikkelsen 2020, eq. 20 and 21, listing 16",
         .parameters = {st, lod},
         .settings = {{"slopes", Setting::Kind::slope_texture, "the height map"}},
         .results = {texel_slope},
         .variants = {{standard,
                       "slope = wr_slope(slopes, st, lod);\n"
                       "slope = wr_v2(slope.x / wr_texture_width(slopes), slope.y / wr_texture_height(slopes));",
                       {2e-5}}},
         .fp64_error = 1e-6,
         .note = "At tilings up to 1e5."},
        {.name = "triplanar_weights",
         .file = "sources/triplanar.clh",
         .summary = "Weights of three planar projections; they sum to 1",
         .source = "Mikkelsen 2020, listing 14",
         .parameters = {given_normal},
         .settings = {{"sharpness", Setting::Kind::number, "exponent k of the weights", {3}}},
         .results = {result(vector("w", "1", "weights of the x, y and z plane"), {absolute})},
         .variants = {{standard, "w = wr_triplanar_weights(n, sharpness);", {3e-7}}},
         .note = "1 + sharpness / 15 times that."},
        {.name = "triplanar_gradient",
         .file = "sources/triplanar.clh",
         .summary = "Volume gradient of three weighted planar projections",
         .source = "Mikkelsen 2020, listing 13",
         .parameters = {vector("w", "1", "weights"), pair("slope_x", "1", "dh/dz, dh/dy, sampled with (z, y)"),
                        pair("slope_y", "1", "dh/dx, dh/dz, sampled with (x, z)"),
                        pair("slope_z", "1", "dh/dx, dh/dy, sampled with (x, y)")},
         .results = {result(vector("dh_dp", "1, world", "volume gradient"), {relative})},
         .variants = {{standard, "dh_dp = wr_triplanar_gradient(w, slope_x, slope_y, slope_z);", {3e-7}}}},
    };
}

}  // namespace wrinkle
