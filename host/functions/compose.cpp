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
        "As many times that as the largest term of the cofactors' sum is longer than the sum. 0 for scales that "
        "flatten "
        "the normal away.";
    return {
        {.name = "resolve",
         .file = "compose/resolve.clh",
         .summary = "The perturbed normal, normalize(n - g)",
         .source = "Mikkelsen 2020, eq. 5, listing 1",
         .parameters = {given_normal, vector("g", "metres per metre, world", "sum of the surface gradients")},
         .results = {result(direction("normal", "perturbed normal"), {degrees})},
         .variants = {{standard, "normal = wr_resolve(n, g);", {1e-5}}},
         .note = "Gradients of any finite length, of either sign: resolving -g mirrors the bump. 0 for g = n."},
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
         .note = "1 / cos(half the angle between n and base) times that. For base = -n the detail mirrored."},
        combine("whiteout", "Whiteout across unwraps: each gradient over the other's cosine"),
        combine("udn", "UDN across unwraps: the detail times its cosine over that of what is below"),
        combine("linear", "The surface gradient of the mean of both normals; to compare with"),
        combine("rnm", "The surface gradient of the detail reoriented onto what is below",
                "Reoriented normals that point inwards are mirrored outwards."),
    };
}

}  // namespace wrinkle
