#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> volume_functions() {
    const Parameter p = vector("p", "voxels", "point in the grid's index space, voxel centres at whole numbers");
    const Result value = result(number("value", "the grid's", "interpolated value"), {absolute}),
                 gradient = result(vector("gradient", "the grid's, per voxel", "its exact gradient"), {absolute});
    return {
        {.name = "volume_trilinear",
         .file = "sources/volume.clh",
         .summary = "Trilinear value of a sparse volume and its exact gradient",
         .source = "trilinear interpolation; layout of OpenVDB's leaves",
         .parameters = {p},
         .settings = {{"volume", Setting::Kind::volume, "the grid"}},
         .results = {value, gradient},
         .variants = {{standard,
                       "wr_field v = wr_volume_trilinear(volume, p);\nvalue = v.value, gradient = v.gradient;",
                       {5e-7, 5e-7}}},
         .note = "For voxels within +-1; else times the largest magnitude, and the largest step between the voxels. "
                 "Outside the grid its background, gradient 0."},
        {.name = "volume_bspline",
         .file = "sources/volume.clh",
         .summary = "Value and gradient of the triquadratic B-spline over a sparse volume: the gradient is continuous",
         .source = "quadratic B-spline basis",
         .parameters = {p},
         .settings = {{"volume", Setting::Kind::smooth_volume, "the grid"}},
         .results = {value, gradient},
         .variants = {{standard,
                       "wr_field v = wr_volume_bspline(volume, p);\nvalue = v.value, gradient = v.gradient;",
                       {5e-7, 5e-7}}},
         .note = "For voxels within +-1; else times the largest magnitude, and the largest step between the voxels. It "
                 "smooths: it does not pass through the voxels. Outside the grid its background, gradient 0."},
        {.name = "volume_vector",
         .file = "sources/volume.clh",
         .summary = "Trilinear vector of a sparse volume of vectors",
         .source = "trilinear interpolation",
         .parameters = {p},
         .settings = {{"volume", Setting::Kind::vector_volume, "the grid, such as bake-volume golden-gradient makes"}},
         .results = {result(vector("v", "the grid's", "interpolated vector"), {absolute})},
         .variants = {{standard, "v = wr_volume_vector(volume, p);", {5e-7}}},
         .note = "For vectors within +-1. Outside the grid its background."},
        {.name = "golden_ratio",
         .file = "sources/golden_ratio.clh",
         .summary = "An implicit surface of cosines and its gradient, which is its exact normal times a length",
         .source = "Mikkelsen, notes on bump mapping, 2011",
         .parameters = {vector("p", "1", "point")},
         .results = {result(number("value", "1", "0 on the surface, negative inside"), {absolute}),
                     result(vector("gradient", "1", "its gradient"), {absolute})},
         .variants = {{standard,
                       "wr_field v = wr_golden_ratio(p);\nvalue = v.value, gradient = v.gradient;",
                       {3e-6, 5e-6}}},
         .note = "Within 10 of the origin."},
        {.name = "golden_march",
         .file = "sources/golden_ratio.clh",
         .summary = "Distance along a ray to the golden-ratio surface",
         .source = "sphere tracing and Newton's method",
         .parameters = {vector("eye", "1", "start of the ray"), direction("ray", "its direction")},
         .settings = {{"radius", Setting::Kind::number, "of the ball around the origin that is searched", {6}}},
         .results = {result(number("distance", "1", "0 where the ray meets nothing"), {relative})},
         .variants = {{standard, "distance = wr_golden_march(eye, ray, (wr_real)(radius));", {5e-7}}},
         .fp64_error = 1e-6,
         .note = "Over the cosine of view."},
    };
}

}  // namespace wrinkle
