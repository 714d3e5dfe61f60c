#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

#include "base/vec.h"
#include "layers/common.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kPerturbedNormal = 75, kTurn = 15;  // expected operations

using Rows = std::array<Vec3, 3>;
const Rows kIdentity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// sign(det m) cof(m): takes normals along when m takes the surface somewhere; the sign keeps them outside where m
/// mirrors. Scaled to a largest entry of 1, as the length of a normal does not matter.
Rows normal_matrix(const Rows& m, const std::string& who) {
    Rows cofactor{};
    for (std::size_t i = 0; i < 3; ++i) cofactor[i] = cross(m[(i + 1) % 3], m[(i + 2) % 3]);
    const double det = dot(m[0], cofactor[0]);
    double largest = 0;
    for (const Vec3& row : cofactor)
        for (const double v : row) largest = std::max(largest, std::abs(v));
    if (!std::isfinite(det) || det == 0)
        throw Error(who + ": object_to_world flattens the object (its determinant is 0 or not finite)");
    for (Vec3& row : cofactor)
        for (double& v : row) v *= (det < 0 ? -1 : 1) / largest;
    return cofactor;
}

bool is_flat(const Rows& m) {
    constexpr double share = 1e-9;  // of the volume that perpendicular rows would span
    return !(std::abs(dot(normalize(m[0]), cross(normalize(m[1]), normalize(m[2])))) > share);
}

bool turns(const ObjectNormalLayer& l) { return l.channels != kIdentity || l.object_to_world != kIdentity; }

/// Three axes such as "x -z y", each once: what red, green and blue point along.
void read_channels(scene::Table& table, std::array<Vec3, 3>& out) {
    if (table.visits()) {
        if (table.read_matrix("channels", out) && is_flat(out))
            table.complain("channels", "must be three directions that do not lie in a plane");
        return;
    }
    std::string text;
    if (!table.read("channels", text)) return;
    std::array<Vec3, 3> axes{};
    std::array<bool, 3> taken{};
    std::istringstream words(text);
    std::size_t count = 0;
    bool good = true;
    for (std::string word; good && words >> word; ++count) {
        const bool sign = word[0] == '-' || word[0] == '+';
        const std::size_t axis = word.size() == (sign ? 2u : 1u) ? std::string_view("xyz").find(word.back()) : 3;
        good = axis < 3 && count < 3 && !taken[axis];
        if (!good) break;
        taken[axis] = true;
        axes[count][axis] = word[0] == '-' ? -1 : 1;
    }
    if (good && count == 3)
        out = axes;
    else
        table.complain("channels",
                       "must name each axis once, as \"x -z y\" does: what red, green and blue point along");
}

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<ObjectNormalLayer>(layer);
    scene::read_texture_of(table, bump.texture, Content::object_normal);
    bool world = false;
    table.choose("space", world, {{"object", false}, {"world", true}});
    read_channels(table, bump.channels);
    table.read_matrix("object_to_world", bump.object_to_world);
    table.only_with("object_to_world", !world, "space", "object");
    table.compiled_in("object_to_world", turns(bump));
    if (!table.is_bad("object_to_world") && is_flat(bump.object_to_world))
        table.complain("object_to_world", "must not flatten the object: its determinant is 0");
    scene::read_mapped(table, bump.texture, bump.uv);
    scene::read_weight(table, layer);
    layer.bump = bump;
}

/// Texture space to the world, for normals, as rows.
Rows turn_of(const ObjectNormalLayer& l, const std::string& who) {
    const Rows normals = normal_matrix(l.object_to_world, who);
    Rows turn{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) turn[i][j] = dot(normals[i], l.channels[j]);
    return turn;
}

std::string emit(LayerText& at) {
    const auto& l = std::get<ObjectNormalLayer>(at.layer.bump);
    std::string text = at.textured(l.texture, "wr_vec3 v");
    at.section.operations += kPerturbedNormal;
    if (turns(l)) {
        text += at.turned("object_to_world", [](const Layer& layer) {
            return turn_of(std::get<ObjectNormalLayer>(layer.bump), layer_label(layer));
        });
        at.section.operations += kTurn;
    }
    return text + fmt::format("        g = wr_fma(wr_surface_gradient_from_perturbed_normal(n, v), m * {}, g);\n",
                              at.strength());
}

}  // namespace

const LayerKind& layers::object_normal() {
    static constexpr LayerKind row{.name = ObjectNormalLayer::kind, .read = read, .emit = emit, .uses = layers::on_uv};
    return row;
}

}  // namespace wrinkle
