#include <fmt/format.h>

#include <cmath>

#include "plan/layer_text.h"
#include "scene/vec.h"

namespace wrinkle {

namespace {

constexpr double kTriplanar = 40;  // expected operations

/// From world space to the space that is projected, in repeats: rows of a matrix, and what the origin adds.
struct Projection {
    std::array<Vec3, 3> rows{};
    Vec3 offset{};
    bool along_axes = true;  ///< a diagonal matrix
};

Projection projection_of(const TriplanarLayer& l) {
    const auto object = object_axes(l.transform);
    Projection to;
    for (std::size_t k = 0; k < 3; ++k) {
        const double sign = k == 2 && l.handedness == Handedness::right ? -1 : 1;
        for (std::size_t j = 0; j < 3; ++j) {
            to.rows[k][j] = sign * object[k][j] / (l.transform.scale[k] * l.tile);
            to.along_axes &= j == k || to.rows[k][j] == 0;
        }
        to.offset[k] = -scene::dot(to.rows[k], l.transform.translate);
    }
    return to;
}

/// Component k of the rows times the vector called `name`, plus `add`.
std::string row_times(const Projection& to, std::size_t k, const std::string& name, const std::string& add) {
    if (to.along_axes)
        return fmt::format("fma({}.{}, (real)({}), (real)({}))", name, "xyz"[k], literal(to.rows[k][k]), add);
    return fmt::format("wr_dot({}, {}) + {}", name, literal(to.rows[k]), add);
}

}  // namespace

std::array<Vec3, 3> object_axes(const Placement& placement) {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (std::size_t about = 0; about < 3; ++about) {
        if (placement.rotate[about] == 0) continue;
        const double c = std::cos(placement.rotate[about]), s = std::sin(placement.rotate[about]);
        const std::size_t a = (about + 1) % 3, b = (about + 2) % 3;
        for (Vec3& axis : axes) {
            const double along_a = axis[a], along_b = axis[b];
            axis[a] = c * along_a - s * along_b, axis[b] = s * along_a + c * along_b;
        }
    }
    return axes;
}

std::string emit(LayerText& at, const TriplanarLayer& l) {
    const Projection to = projection_of(l);
    const std::size_t origin =
        4 * at.emitter.origin({.axes = {to.rows[0], to.rows[1], to.rows[2]}, .offset = to.offset, .period = 1});
    at.section.reads.insert({"p", "n", "dp_dx", "dp_dy"});
    at.section.operations += kTriplanar + 3 * sample_cost(l.texture);
    const auto all = [&](const std::string& name, bool offset) {
        std::string parts;
        for (std::size_t k = 0; k < 3; ++k)
            parts += (k ? ",\n                       " : "") +
                     row_times(to, k, name, offset ? fmt::format("origins[{}]", origin + k) : "0");
        return parts;
    };
    std::string text = fmt::format(
        "        wr_texture t = wr_texture_at(texels, textures, {});\n"
        "        vec3 q = wr_v3({});\n"
        "        vec3 qx = wr_v3({});\n"
        "        vec3 qy = wr_v3({});\n",
        at.emitter.texture(l.texture, texel_kind(l.texture)), all("p", true), all("dp_dx", false), all("dp_dy", false));
    if (l.transform == Placement{}) {
        text += fmt::format("        vec3 w = wr_triplanar_weights(n, {});\n", literal(l.sharpness));
    } else {  // the normal in object space: columns of the inverse are rows of the inverse transposed
        const auto axes = object_axes(l.transform);
        std::string parts;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 column{axes[k][0] * l.transform.scale[k], axes[k][1] * l.transform.scale[k],
                              axes[k][2] * l.transform.scale[k]};
            parts += (k ? ", " : "") + fmt::format("wr_dot(n, {})", literal(column));
        }
        text += fmt::format("        vec3 w = wr_triplanar_weights(wr_normalize(wr_v3({})), {});\n", parts,
                            literal(l.sharpness));
    }
    const bool upper = l.origin == TextureOrigin::upper_left;
    const struct {
        const char *weight, *s, *t, *name;
    } planes[] = {{"w.x", "z", "y", "slope_x"}, {"w.y", "x", "z", "slope_y"}, {"w.z", "x", "y", "slope_z"}};
    for (const auto& plane : planes) {
        text += fmt::format(
            "        vec2 {3} = wr_v2((real)(0), (real)(0));\n"
            "        if (wr_any(active & ({0} > 0)))\n"
            "            {3} = {4}(t, wr_v2(q.{1}, {6}q.{2}), {5});\n",
            plane.weight, plane.s, plane.t, plane.name, sample_function(l.texture),
            at.lod(fmt::format("wr_v2(qx.{}, qx.{})", plane.s, plane.t),
                   fmt::format("wr_v2(qy.{}, qy.{})", plane.s, plane.t)),
            upper ? "-" : "");
        if (upper) text += fmt::format("        {0}.y = -{0}.y;\n", plane.name);
        if (l.mode == TriplanarMode::geiss) text += fmt::format("        {0} = wr_normal_offset({0});\n", plane.name);
    }
    text += "        vec3 slopes = wr_triplanar_gradient(w, slope_x, slope_y, slope_z);\n";
    // To world space by the transposed rows; slopes of normals have no unit and take directions only.
    std::array<Vec3, 3> columns{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double size =
            l.texture.content == Content::normal ? 1 / std::sqrt(scene::dot(to.rows[k], to.rows[k])) : 1;
        for (std::size_t j = 0; j < 3; ++j) columns[j][k] = to.rows[k][j] * size;
    }
    std::string parts;
    for (std::size_t j = 0; j < 3; ++j)
        parts += (j ? ", " : "") + (to.along_axes ? fmt::format("slopes.{} * {}", "xyz"[j], literal(columns[j][j]))
                                                  : fmt::format("wr_dot(slopes, {})", literal(columns[j])));
    return text + at.volume(fmt::format("wr_v3({})", parts));
}

}  // namespace wrinkle
