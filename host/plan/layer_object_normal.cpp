#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/layer_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kPerturbedNormal = 75, kTurn = 15;  // expected operations

using Rows = std::array<Vec3, 3>;
const Rows kIdentity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// sign(det) cof(m): turns normals as m turns the surface, its outside staying outside where m mirrors. The largest
/// number is 1, because the length of a normal does not matter.
Rows normal_matrix(const Rows& m, const std::string& who) {
    Rows cofactor{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            cofactor[i][j] = m[(i + 1) % 3][(j + 1) % 3] * m[(i + 2) % 3][(j + 2) % 3] -
                             m[(i + 1) % 3][(j + 2) % 3] * m[(i + 2) % 3][(j + 1) % 3];
    const double det = m[0][0] * cofactor[0][0] + m[0][1] * cofactor[0][1] + m[0][2] * cofactor[0][2];
    double largest = 0;
    for (const Vec3& row : cofactor)
        for (const double v : row) largest = std::max(largest, std::abs(v));
    if (!std::isfinite(det) || det == 0)
        throw Error(who + ": object_to_world flattens the object (its determinant is 0 or not finite)");
    for (Vec3& row : cofactor)
        for (double& v : row) v *= (det < 0 ? -1 : 1) / largest;
    return cofactor;
}

}  // namespace

std::string emit(LayerText& at, const ObjectNormalLayer& l) {
    std::string text = at.textured(l.texture, l.uv, "wr_vec3 v");
    at.section.operations += kPerturbedNormal;
    if (l.channels != kIdentity || l.object_to_world != kIdentity) {
        const Rows normals = normal_matrix(l.object_to_world, at.who);
        Rows turn{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                for (std::size_t k = 0; k < 3; ++k) turn[i][j] += normals[i][k] * l.channels[j][k];
        text +=
            fmt::format("        v = wr_turn({}, {}, {}, v);\n", literal(turn[0]), literal(turn[1]), literal(turn[2]));
        at.section.operations += kTurn;
    }
    return text + fmt::format("        g = wr_fma(wr_surface_gradient_from_perturbed_normal(n, v), m * {}, g);\n",
                              at.strength());
}

}  // namespace wrinkle
