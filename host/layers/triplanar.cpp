#include <fmt/format.h>

#include <cmath>

#include "base/vec.h"
#include "layers/common.h"
#include "plan/noise_text.h"
#include "scene/placement.h"

namespace wrinkle {

namespace {

constexpr double kTriplanar = 40, kPerturbedNormal = 75;  // expected operations

/// Whether `holds` is true of the source of every plane.
template <class Holds>
bool every_plane(const TriplanarLayer& bump, const Holds& holds) {
    bool all = true;
    for (const auto& plane : bump.planes)
        all = all && std::visit(holds, plane ? plane->content : decltype(plane->content)(bump.texture));
    return all;
}

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<TriplanarLayer>(layer);
    scene::read_planes(table, bump);
    table.read("tile", bump.tile, scene::positive);
    table.read("sharpness", bump.sharpness, {.low = 0, .high = 1000, .low_is_allowed = false});
    table.choose("origin", bump.origin,
                 {{"lower_left", TextureOrigin::lower_left}, {"upper_left", TextureOrigin::upper_left}});
    table.choose("handedness", bump.handedness, {{"left", Handedness::left}, {"right", Handedness::right}});
    table.choose("mode", bump.mode,
                 {{"surface_gradient", TriplanarMode::surface_gradient},
                  {"perlin", TriplanarMode::perlin},
                  {"geiss", TriplanarMode::geiss}});
    const auto tangent = [](const auto& source) {
        if constexpr (requires { source.content; }) return source.content == Content::normal;
        return false;
    };
    if (bump.mode == TriplanarMode::geiss && !every_plane(bump, tangent))
        table.complain("mode", "can be \"geiss\" only with content = \"normal\": it uses normals as they are");
    const auto projects = [](const auto& source) {
        if constexpr (requires { source.content; }) return source.content != Content::object_normal;
        return true;
    };
    if (bump.mode != TriplanarMode::surface_gradient && !every_plane(bump, projects))
        table.complain("mode",
                       "must be \"surface_gradient\" with content = \"object_normal\": such normals have no slopes");
    if (auto placement = table.table("transform", "transform of " + table.where()))
        scene::read_placement(*placement, bump.transform);
    table.compiled_in("transform", bump.transform != Placement{});
    table.compiled_in("transform.rotate", bump.transform.rotate != Vec3{});
    scene::read_weight(table, layer);
    layer.project = bump.mode == TriplanarMode::surface_gradient;
    layer.bump = bump;
}

const TriplanarLayer& triplanar_of(const Layer& layer) { return std::get<TriplanarLayer>(layer.bump); }

/// From world space to the space that is projected, in repeats: rows of a matrix, and what the origin adds.
struct Projection {
    std::array<Vec3, 3> rows{};
    Vec3 offset{};

    double size(std::size_t k) const { return std::sqrt(dot(rows[k], rows[k])); }  ///< repeats per metre
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
        for (std::size_t j = 0; j < 3; ++j) to.rows[k][j] = sign * object[k][j] / (l.transform.scale[k] * l.tile);
        to.offset[k] = -dot(to.rows[k], l.transform.translate);
    }
    return to;
}

/// Two components of a vector, as text.
std::string pair_of(const char* vector, const Plane& plane, const char* t_sign = "") {
    return fmt::format("wr_v2({0}.{1}, {3}{0}.{2})", vector, "xyz"[plane.s], "xyz"[plane.t], t_sign);
}

/// The factor of a plane's own source.
double plane_scale(const TriplanarLayer& l, std::size_t plane) { return l.planes[plane] ? l.planes[plane]->scale : 1; }

/// The space of a plane's noise: its two coordinates in metres, and a third of a cell deep.
NoiseAxes plane_axes(const TriplanarLayer& l, std::size_t plane) {
    const Projection to = projection_of(l);
    const std::size_t from[] = {kPlanes[plane].s, kPlanes[plane].t};
    NoiseAxes space;
    space.axes[2] = {};
    space.offset[2] = 1 / (3 * std::get<NoiseLayer>(l.planes[plane].value().content).frequency);
    for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t j = 0; j < 3; ++j) space.axes[k][j] = to.rows[from[k]][j] * l.tile;
        space.offset[k] = to.offset[from[k]] * l.tile;
    }
    return space;
}

class TriplanarText {
public:
    explicit TriplanarText(LayerText& at)
        : at_(at), l_(triplanar_of(at.layer)), along_axes_(l_.transform.rotate == Vec3{}) {
        rows_ =
            at.matrix("world to repeats", [](const Layer& layer) { return projection_of(triplanar_of(layer)).rows; });
    }

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
                text += std::visit([&](const auto& content) { return plane(k, content); }, own->content);
            else
                text += plane(k, l_.texture);
            text += "        }\n";
        }
        return text + (slopes_ ? sum() : "");
    }

private:
    /// Component k of the rows times the vector called `name`, plus `add`.
    std::string row_times(std::size_t k, const std::string& name, const std::string& add) const {
        if (along_axes_)
            return fmt::format("fma({}.{}, (wr_real)(numbers[{}]), (wr_real)({}))", name, "xyz"[k], rows_ + 4 * k, add);
        return fmt::format("wr_dot({}, wr_v3(numbers + {})) + {}", name, rows_ + 3 * k, add);
    }

    std::string coordinates() const {
        const std::size_t origin = 4 * at_.emitter.eye_place(at_.layer, [](const Layer& layer) {
            const Projection to = projection_of(triplanar_of(layer));
            return EyePlace{.axes = to.rows, .offset = to.offset, .period = 1};
        });
        const auto all = [&](const std::string& name, bool offset) {
            std::string parts;
            for (std::size_t k = 0; k < 3; ++k)
                parts += (k ? ",\n                       " : "") +
                         row_times(k, name, offset ? fmt::format("eye_places[{}]", origin + k) : "0");
            return parts;
        };
        return fmt::format(
            "        wr_vec3 q = wr_v3({});\n"
            "        wr_vec3 qx = wr_v3({});\n"
            "        wr_vec3 qy = wr_v3({});\n",
            all("p", true), all("dp_dx", false), all("dp_dy", false));
    }

    std::string weights() const {
        const std::string sharpness =
            at_.number("sharpness", [](const Layer& layer) { return triplanar_of(layer).sharpness; });
        if (l_.transform == Placement{})
            return fmt::format("        wr_vec3 w = wr_triplanar_weights(n, {});\n", sharpness);
        // The normal in object space: columns of the inverse are rows of the inverse transposed.
        const std::size_t columns = at_.matrix("transform", [](const Layer& layer) {
            const Placement& placement = triplanar_of(layer).transform;
            auto axes = object_axes(placement);
            for (std::size_t k = 0; k < 3; ++k)
                for (double& part : axes[k]) part *= placement.scale[k];
            return axes;
        });
        return fmt::format(
            "        wr_vec3 w = wr_triplanar_weights(wr_normalize(wr_v3(wr_dot(n, wr_v3(numbers + {})), wr_dot(n, "
            "wr_v3(numbers + {})), wr_dot(n, wr_v3(numbers + {})))), {});\n",
            columns, columns + 3, columns + 6, sharpness);
    }

    /// Sets the plane's slopes per repeat. A texture of object-space normals has no slopes: it adds to g.
    std::string plane(std::size_t k, const TextureUse& use) {
        const Plane& plane = kPlanes[k];
        at_.section.operations += sample_cost(use);
        const bool upper = l_.origin == TextureOrigin::upper_left, vector = use.content == Content::object_normal;
        std::string text = fmt::format(
            "            wr_texture t = wr_texture_at(texels, textures, {});\n"
            "            {} = {};\n",
            at_.emitter.texture(use, texel_kind(use)), vector ? "wr_vec3 v" : plane.slope,
            sample_text(use, pair_of("q", plane, upper ? "-" : ""),
                        at_.lod(pair_of("qx", plane), pair_of("qy", plane))));
        if (vector) return text + perturbed(k);
        slopes_ = true;
        if (upper) text += fmt::format("            {0}.y = -{0}.y;\n", plane.slope);
        if (l_.mode == TriplanarMode::geiss)
            text += fmt::format("            {0} = wr_normal_offset({0});\n", plane.slope);
        // Slopes of normals have no unit. sum() expects slopes per repeat, so they are multiplied by the metres of one.
        const bool normal = use.content == Content::normal;
        return text + scaled(k, [normal, k](const TriplanarLayer& l, std::size_t axis) {
                   return normal ? plane_scale(l, k) / projection_of(l).size(axis) : plane_scale(l, k);
               });
    }

    /// Adds the plane's normal `v` to g.
    std::string perturbed(std::size_t k) {
        at_.section.reads.insert("g");
        at_.section.writes.insert("g");
        at_.section.operations += kPerturbedNormal;
        std::string text;
        if (l_.transform != Placement{})
            text = at_.turned("transform",
                              [](const Layer& layer) { return normals_to_world(triplanar_of(layer).transform); });
        const std::string scale =
            at_.number("scale of a plane", [k](const Layer& layer) { return plane_scale(triplanar_of(layer), k); });
        return text + fmt::format(
                          "            g = wr_fma(wr_limit_slope(wr_surface_gradient_from_perturbed_normal(n, v)), "
                          "m * {} * ({} * {}), g);\n",
                          kPlanes[k].weight, at_.strength(), scale);
    }

    std::string plane(std::size_t k, const NoiseLayer&) {
        slopes_ = true;
        const Plane& plane = kPlanes[k];
        const auto axis = [&](std::size_t of) {
            return at_.vector("axis of a plane",
                              [k, of](const Layer& layer) { return plane_axes(triplanar_of(layer), k).axes[of]; });
        };
        NoiseSpace space;
        space.axes = [k](const Layer& layer) { return plane_axes(triplanar_of(layer), k); };
        space.point = fmt::format("wr_v3(wr_dot(p, {}), wr_dot(p, {}), (wr_real)(0))", axis(0), axis(1));
        space.step = fmt::format("wr_v3(wr_dot(dp_dx, {}), wr_dot(dp_dx, {}), (wr_real)(0))", axis(0), axis(1));
        const auto length = [&](const char* q) {
            return fmt::format("wr_v3({0}.{1}, {0}.{2}, (wr_real)(0))", q, "xyz"[plane.s], "xyz"[plane.t]);
        };
        space.footprint = fmt::format("{} * wr_footprint_size({}, {})",
                                      at_.number("tile", [](const Layer& layer) { return triplanar_of(layer).tile; }),
                                      length("qx"), length("qy"));
        space.active = fmt::format("active & ({} > 0)", plane.weight);
        const NoiseOf noise = [k](const Layer& layer) -> const NoiseLayer& {
            return std::get<NoiseLayer>(triplanar_of(layer).planes[k].value().content);
        };
        return noise_over(at_, noise, space) +
               fmt::format("            {} = wr_v2(f.gradient.x, f.gradient.y);\n", plane.slope) +
               scaled(k, [k](const TriplanarLayer& l, std::size_t) { return plane_scale(l, k) * l.tile; });
    }

    /// Scales a plane's slopes; `by` gives the factor along an axis of the projected space.
    template <class By>
    std::string scaled(std::size_t k, const By& by) {
        const std::size_t factors =
            at_.emitter.numbers(at_.layer, "scale of a plane", [k, by](const Layer& layer, const auto&) {
                const TriplanarLayer& l = triplanar_of(layer);
                return std::vector<double>{by(l, kPlanes[k].s), by(l, kPlanes[k].t)};
            });
        return fmt::format("            {0} = wr_v2({0}.x * numbers[{1}], {0}.y * numbers[{2}]);\n", kPlanes[k].slope,
                           factors, factors + 1);
    }

    /// The weighted sum, to world space by the transposed rows.
    std::string sum() const {
        std::string parts;
        for (std::size_t j = 0; j < 3; ++j)
            parts += (j ? ", " : "") +
                     (along_axes_ ? fmt::format("slopes.{} * numbers[{}]", "xyz"[j], rows_ + 4 * j)
                                  : fmt::format("wr_dot(slopes, wr_v3((wr_real)(numbers[{}]), (wr_real)(numbers[{}]), "
                                                "(wr_real)(numbers[{}])))",
                                                rows_ + j, rows_ + 3 + j, rows_ + 6 + j));
        return "        wr_vec3 slopes = wr_triplanar_gradient(w, slope_x, slope_y, slope_z);\n" +
               at_.volume(fmt::format("wr_v3({})", parts));
    }

    LayerText& at_;
    const TriplanarLayer& l_;
    bool along_axes_;       ///< the projected space is not rotated: products with zeros are left out
    bool slopes_ = false;   ///< some plane has them
    std::size_t rows_ = 0;  ///< index of the projection's numbers
};

std::string emit(LayerText& at) { return TriplanarText(at).text(); }

}  // namespace

const LayerKind& layers::triplanar() {
    static constexpr LayerKind row{.name = TriplanarLayer::kind, .read = read, .emit = emit};
    return row;
}

}  // namespace wrinkle
