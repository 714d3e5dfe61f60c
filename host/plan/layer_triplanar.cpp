#include <fmt/format.h>

#include <cmath>

#include "plan/layer_text.h"
#include "scene/vec.h"

namespace wrinkle {

namespace {

constexpr double kTriplanar = 40, kPerturbedNormal = 75;  // expected operations

/// From world space to the space that is projected, in repeats: rows of a matrix, and what the origin adds.
struct Projection {
    std::array<Vec3, 3> rows{};
    Vec3 offset{};
    bool along_axes = true;  ///< a diagonal matrix

    double size(std::size_t k) const { return std::sqrt(scene::dot(rows[k], rows[k])); }  ///< repeats per metre
};

/// One of the three planes: the components of q that are its coordinates, and its names in the kernel text.
struct Plane {
    std::size_t s, t;
    const char *weight, *slope;
};
constexpr Plane kPlanes[] = {{2, 1, "w.x", "slope_x"}, {0, 2, "w.y", "slope_y"}, {0, 1, "w.z", "slope_z"}};

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
        return fmt::format("fma({}.{}, (wr_real)({}), (wr_real)({}))", name, "xyz"[k], literal(to.rows[k][k]), add);
    return fmt::format("wr_dot({}, {}) + {}", name, literal(to.rows[k]), add);
}

/// Two components of a vector, as text.
std::string pair_of(const char* vector, const Plane& plane, const char* t_sign = "") {
    return fmt::format("wr_v2({0}.{1}, {3}{0}.{2})", vector, "xyz"[plane.s], "xyz"[plane.t], t_sign);
}

/// A direction in the space that is projected, as rows to the world: sign(det) cof(M) but for its length.
std::array<Vec3, 3> normals_to_world(const Placement& placement) {
    const auto axes = object_axes(placement);
    std::array<Vec3, 3> rows{};
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) rows[j][k] = axes[k][j] / placement.scale[k];
    return rows;
}

class TriplanarText {
public:
    TriplanarText(LayerText& at, const TriplanarLayer& layer) : at_(at), l_(layer), to_(projection_of(layer)) {}

    std::string text() {
        at_.section.reads.insert({"p", "n", "dp_dx", "dp_dy"});
        at_.section.operations += kTriplanar;
        std::string text = coordinates() + weights();
        for (std::size_t k = 0; k < 3; ++k) {
            text += fmt::format(
                "        wr_vec2 {1} = wr_v2((wr_real)(0), (wr_real)(0));\n"
                "        if (wr_any(active & ({0} > 0))) {{\n",
                kPlanes[k].weight, kPlanes[k].slope);
            if (const auto& own = l_.planes[k])
                text += std::visit([&](const auto& content) { return plane(kPlanes[k], content, own->scale); },
                                   own->content);
            else
                text += plane(kPlanes[k], l_.texture, 1);
            text += "        }\n";
        }
        return text + (slopes_ ? sum() : "");
    }

private:
    std::string coordinates() const {
        const std::size_t origin = 4 * at_.emitter.origin({.axes = to_.rows, .offset = to_.offset, .period = 1});
        const auto all = [&](const std::string& name, bool offset) {
            std::string parts;
            for (std::size_t k = 0; k < 3; ++k)
                parts += (k ? ",\n                       " : "") +
                         row_times(to_, k, name, offset ? fmt::format("origins[{}]", origin + k) : "0");
            return parts;
        };
        return fmt::format(
            "        wr_vec3 q = wr_v3({});\n"
            "        wr_vec3 qx = wr_v3({});\n"
            "        wr_vec3 qy = wr_v3({});\n",
            all("p", true), all("dp_dx", false), all("dp_dy", false));
    }

    std::string weights() const {
        if (l_.transform == Placement{})
            return fmt::format("        wr_vec3 w = wr_triplanar_weights(n, {});\n", literal(l_.sharpness));
        // The normal in object space: columns of the inverse are rows of the inverse transposed.
        const auto axes = object_axes(l_.transform);
        std::string parts;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 column{axes[k][0] * l_.transform.scale[k], axes[k][1] * l_.transform.scale[k],
                              axes[k][2] * l_.transform.scale[k]};
            parts += (k ? ", " : "") + fmt::format("wr_dot(n, {})", literal(column));
        }
        return fmt::format("        wr_vec3 w = wr_triplanar_weights(wr_normalize(wr_v3({})), {});\n", parts,
                           literal(l_.sharpness));
    }

    /// Sets the plane's slopes per repeat; a texture of object-space normals adds to g instead, they are perturbed
    /// already.
    std::string plane(const Plane& plane, const TextureUse& use, double scale) {
        at_.section.operations += sample_cost(use);
        const bool upper = l_.origin == TextureOrigin::upper_left, vector = use.content == Content::object_normal;
        std::string text = fmt::format(
            "            wr_texture t = wr_texture_at(texels, textures, {});\n"
            "            {} = {};\n",
            at_.emitter.texture(use, texel_kind(use)), vector ? "wr_vec3 v" : plane.slope,
            sample_text(use, pair_of("q", plane, upper ? "-" : ""),
                        at_.lod(pair_of("qx", plane), pair_of("qy", plane))));
        if (vector) {
            at_.section.reads.insert("g");
            at_.section.writes.insert("g");
            at_.section.operations += kPerturbedNormal;
            if (l_.transform != Placement{}) {
                const auto rows = normals_to_world(l_.transform);
                text += fmt::format("            v = wr_turn({}, {}, {}, v);\n", literal(rows[0]), literal(rows[1]),
                                    literal(rows[2]));
            }
            return text + fmt::format(
                              "            g = wr_fma(wr_limit_slope(wr_surface_gradient_from_perturbed_normal(n, v)), "
                              "m * {} * "
                              "({} * {}), g);\n",
                              plane.weight, at_.strength(), literal(scale));
        }
        slopes_ = true;
        if (upper) text += fmt::format("            {0}.y = -{0}.y;\n", plane.slope);
        if (l_.mode == TriplanarMode::geiss)
            text += fmt::format("            {0} = wr_normal_offset({0});\n", plane.slope);
        // Slopes of normals have no unit: they rise over as much as the sum takes for a repeat.
        const bool normal = use.content == Content::normal;
        return text + scaled(plane.slope, normal ? scale / to_.size(plane.s) : scale,
                             normal ? scale / to_.size(plane.t) : scale);
    }

    std::string plane(const Plane& plane, const NoiseLayer& noise, double scale) {
        slopes_ = true;
        NoiseSpace space;
        const std::size_t from[] = {plane.s, plane.t};
        space.axes[2] = {};
        space.offset[2] = 1 / (3 * noise.frequency);
        for (std::size_t k = 0; k < 2; ++k) {
            for (std::size_t j = 0; j < 3; ++j) space.axes[k][j] = to_.rows[from[k]][j] * l_.tile;
            space.offset[k] = to_.offset[from[k]] * l_.tile;
        }
        space.point = fmt::format("wr_v3(wr_dot(p, {}), wr_dot(p, {}), (wr_real)(0))", literal(space.axes[0]),
                                  literal(space.axes[1]));
        const auto length = [&](const char* q) {
            return fmt::format("wr_v3({0}.{1}, {0}.{2}, (wr_real)(0))", q, "xyz"[plane.s], "xyz"[plane.t]);
        };
        space.footprint = fmt::format("{} * wr_footprint_size({}, {})", literal(l_.tile), length("qx"), length("qy"));
        space.active = fmt::format("active & ({} > 0)", plane.weight);
        return noise_over(at_, noise, space) +
               fmt::format("            {} = wr_v2(f.gradient.x, f.gradient.y);\n", plane.slope) +
               scaled(plane.slope, scale * l_.tile, scale * l_.tile);
    }

    static std::string scaled(const char* slope, double s, double t) {
        if (s == 1 && t == 1) return "";
        return fmt::format("            {0} = wr_v2({0}.x * {1}, {0}.y * {2});\n", slope, literal(s), literal(t));
    }

    /// The weighted sum, to world space by the transposed rows.
    std::string sum() const {
        std::array<Vec3, 3> columns{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t j = 0; j < 3; ++j) columns[j][k] = to_.rows[k][j];
        std::string parts;
        for (std::size_t j = 0; j < 3; ++j)
            parts += (j ? ", " : "") + (to_.along_axes ? fmt::format("slopes.{} * {}", "xyz"[j], literal(columns[j][j]))
                                                       : fmt::format("wr_dot(slopes, {})", literal(columns[j])));
        return "        wr_vec3 slopes = wr_triplanar_gradient(w, slope_x, slope_y, slope_z);\n" +
               at_.volume(fmt::format("wr_v3({})", parts));
    }

    LayerText& at_;
    const TriplanarLayer& l_;
    const Projection to_;
    bool slopes_ = false;  ///< some plane has them
};

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

std::string emit(LayerText& at, const TriplanarLayer& l) { return TriplanarText(at, l).text(); }

}  // namespace wrinkle
