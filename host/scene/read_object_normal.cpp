#include <cmath>
#include <sstream>
#include <string_view>

#include "base/vec.h"
#include "scene/layer_readers.h"

namespace wrinkle::scene {
namespace {

/// Three axes such as "x -z y", each once: what red, green and blue point along.
void read_channels(Table& table, std::array<Vec3, 3>& out) {
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

}  // namespace

void read_object_normal(Table& table, Layer& layer) {
    ObjectNormalLayer bump;
    read_texture_file(table, bump.texture);
    bool world = false;
    table.choose("space", world, {{"object", false}, {"world", true}});
    read_channels(table, bump.channels);
    table.read_matrix("object_to_world", bump.object_to_world);
    table.only_with("object_to_world", !world, "space", "object");
    const auto& m = bump.object_to_world;
    constexpr double flat = 1e-9;  // as a share of what rows of these lengths span
    if (!table.is_bad("object_to_world") &&
        !(std::abs(dot(normalize(m[0]), cross(normalize(m[1]), normalize(m[2])))) > flat))
        table.complain("object_to_world", "must not flatten the object: its determinant is 0");
    read_mapped(table, bump.texture, bump.uv);
    read_weight(table, layer);
    layer.bump = bump;
}

}  // namespace wrinkle::scene
