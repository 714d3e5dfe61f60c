#include "functions/describe.h"

namespace wrinkle {

using namespace describe;
using enum ErrorMeasure;
using enum Precision;

std::vector<Function> compose_functions() {
    return {
        {.name = "resolve",
         .file = "compose/resolve.clh",
         .summary = "The perturbed normal, normalize(n - g)",
         .source = "Mikkelsen 2020, eq. 5, listing 1",
         .parameters = {given_normal, vector("g", "metres per metre, world", "sum of the surface gradients")},
         .results = {result(direction("normal", "perturbed normal"), {degrees})},
         .variants = {{standard, "normal = wr_resolve(n, g);", {1e-5}}},
         .note = "Gradients of any finite length. 0 for g = n."},
    };
}

}  // namespace wrinkle
