#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

namespace {

/// Blends of two tangent-space normals on one unwrap.
Function blend(const std::string& name, std::string summary, std::string source, std::string note = {}) {
    return {.name = "blend_" + name,
            .file = "compose/blend.clh",
            .summary = std::move(summary),
            .source = std::move(source),
            .parameters = {vector("a", "about unit, tangent space", "the first normal"),
                           vector("b", "about unit, tangent space", "the second normal")},
            .results = {result(vector("normal", "unit, tangent space", "the blend"), {degrees})},
            .variants = {{standard, "normal = wr_blend_" + name + "(a, b);", {1e-5}}},
            .note = std::move(note)};
}

/// Blends of two surface gradients, from the same or different unwraps.
Function combine(const std::string& name, std::string summary, std::string note = {}) {
    return {
        .name = "combine_" + name,
        .file = "compose/blend.clh",
        .summary = std::move(summary),
        .source = "Mikkelsen 2020, section 4.2, table 1",
        .parameters = {base_normal, surface_gradient,
                       vector("detail", "metres per metre, world", "surface gradient of what is added")},
        .results = {result(vector("combined", "metres per metre, world", "surface gradient of both"),
                           {relative, resolved_degrees})},
        .variants = {{standard, "combined = wr_combine_" + name + "(g, detail);", {1e-6, 2e-5}}},
        .fp64_error = 5e-6,
        .note =
            "Slopes are limited to 128. The relative error is to the size of what is added up. Gradients of floats are "
            "tangent only to their digits, so double is no better than that. n is not read. " +
            note};
}

}  // namespace

std::vector<Function> compose_functions() {
    const std::vector<Setting> object{
        {"x", Setting::Kind::vector, "the object's x axis in world space, with its scale", {1, 0, 0}},
        {"y", Setting::Kind::vector, "its y axis", {0, 1, 0}},
        {"z", Setting::Kind::vector, "its z axis", {0, 0, 1}}};
    const Parameter object_normal = direction("n", "base normal in object space"),
                    object_gradient = vector("g", "1", "surface gradient in object space");
    const std::string growth =
        "error <= bound x ||largest term|| / ||sum|| for the sum over the cofactors. 0 for scales that flatten the "
        "normal away.";
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
         .note = "Gradients of any finite length, of either sign: resolving -g mirrors the bump. 0 for g = n."},
        {.name = "combine_towards",
         .file = "compose/blend.clh",
         .summary = "The surface gradient of a perturbed normal mixed with another one; to compare with",
         .source = "Mikkelsen 2020, section 4.5, figure 6",
         .parameters = {base_normal, surface_gradient, direction("other", "the normal to mix in"),
                        number("weight", "1", "share of the other, within [0, 1]")},
         .results = {result(vector("combined", "metres per metre, world", "surface gradient of the mean"),
                            {resolved_degrees})},
         .variants = {{standard, "combined = wr_combine_towards(n, g, other, weight);", {1e-5}}},
         .note = "error <= bound / ||mean of the normals||. g for weight = 0."},
        {.name = "project_to_texture",
         .file = "compose/parallax.clh",
         .summary = "A direction in texture space: per metre along it, and per metre of height that it climbs",
         .source = "Mikkelsen 2020, listing 11; per metre along it as Welsh 2004",
         .parameters = {base_normal, dp_dx, dp_dy, dst_dx, dst_dy, direction("dir", "such as the one to the viewer")},
         .results = {result(pair("along", "per metre", "change of the texture coordinates along dir"), {relative}),
                     result(pair("climbing", "per metre", "along / |n . dir|"), {relative})},
         .variants = {{standard,
                       "along = wr_project_to_texture(n, dp_dx, dp_dy, dst_dx, dst_dy, dir);\n"
                       "wr_real climb = fabs(wr_dot2(n, dir));\n"
                       "climbing = wr_scale(along, climb > 0 ? 1 / climb : (wr_real)(0));",
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
                      {"steps", Setting::Kind::number, "linear steps, at most", {32}, 1, 1024, true},
                      {"refine", Setting::Kind::number, "refinements after them", {3}, 0, 16, true},
                      {"level", Setting::Kind::number, "the height that lies on the surface", {0}}},
         .results = {result(number("height", "1", "in [0, 1]; the coordinates there are st + range (height - level)"),
                            {absolute})},
         .variants = {{standard,
                       "wr_real step = wr_parallax_step(heights, range, lod, (int)steps);\n"
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
        {.name = "resolve_object",
         .file = "compose/object_scale.clh",
         .summary = "The perturbed normal of a scaled object in world space, sign(det M) cof(M) (n - g), normalised",
         .source = "Exploring the Surface Gradient, 2019, eq. 16 to 33",
         .parameters = {object_normal, object_gradient},
         .settings = object,
         .results = {result(direction("normal", "perturbed normal"), {degrees})},
         .variants = {{standard, "normal = wr_resolve_object(x, y, z, n, g);", {1e-5}}},
         .fp64_error = 5e-6,
         .note = growth},
        {.name = "surface_gradient_to_world",
         .file = "compose/object_scale.clh",
         .summary = "The surface gradient of a scaled object, for its normal in world space",
         .source = "Exploring the Surface Gradient, 2019, eq. 33 and 38",
         .parameters = {object_normal, object_gradient},
         .settings = object,
         .results = {result(direction("world_n", "the object's normal in world space"), {degrees}),
                     result(vector("world_g", "metres per metre, world", "surface gradient on it"), {absolute})},
         .variants = {{standard,
                       "world_n = wr_resolve_object(x, y, z, n, wr_zero3());\n"
                       "world_g = wr_surface_gradient_to_world(x, y, z, n, g, world_n);",
                       {1e-5, 2e-6}}},
         .fp64_error = 5e-6,
         .note = growth + " The gradient's error also grows with its own square: it is one of the normal."},
        {.name = "perturb_perlin_1985",
         .file = "compose/resolve.clh",
         .summary = "Perlin's perturbation, normalize(n - dh_dp), unprojected: wrong on purpose, to compare with",
         .source = "Perlin 1985; Mikkelsen 2020, section 3.6, figure 4",
         .parameters = {given_normal, vector("dh_dp", "metres per metre, world", "volume gradient")},
         .results = {result(direction("normal", "perturbed normal"), {degrees})},
         .variants = {{standard, "normal = wr_perturb_perlin_1985(n, dh_dp);", {1e-5}}},
         .note = "Normals may face inwards. 0 for dh_dp = n."},
        blend("partial_derivative", "The slopes of both normals added up", "Mikkelsen 2020, section 4.2"),
        blend("whiteout", "Whiteout: x and y added, z multiplied", "Mikkelsen 2020, section 4.2"),
        blend("udn", "UDN: x and y added, z of the first", "Mikkelsen 2020, section 4.2"),
        blend("rnm", "Reoriented normal mapping: the second turned by what turns z to the first",
              "Mikkelsen 2020, eq. 18, normalised", "For a = (0, 0, -1) the second mirrored."),
        blend("linear", "The mean of both normals; flattens them, here to compare with", "Mikkelsen 2020, section 4.2"),
        {.name = "reorient_normal",
         .file = "compose/blend.clh",
         .summary = "A detail normal turned by the shortest rotation from n to another base normal",
         .source = "Mikkelsen 2020, eq. 18, about any normal",
         .parameters = {base_normal, direction("base", "the normal to turn to"),
                        direction("detail", "the normal to turn, perturbed from n")},
         .results = {result(direction("normal", "the detail on its new base"), {degrees})},
         .variants = {{standard, "normal = wr_reorient(n, base, detail);", {1e-5}}},
         .note = "error <= bound / cos(half the angle between n and base). For base = -n the detail mirrored."},
        combine("whiteout", "Whiteout across unwraps: each gradient over the other's cosine"),
        combine("udn", "UDN across unwraps: the detail times its cosine over that of what is below"),
        combine("linear", "The surface gradient of the mean of both normals; to compare with"),
        combine("rnm", "The surface gradient of the detail reoriented onto what is below",
                "Reoriented normals that point inwards are mirrored outwards."),
    };
}

}  // namespace wrinkle
