#include <fmt/format.h>

#include <algorithm>

#include "layers/common.h"
#include "plan/geometry_text.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr double kProjection = 140, kMove = 40, kHeightSample = 40;  // expected operations
constexpr double kDeepest = 1e6;                                     // metres; keeps what is moved within float32

void read(scene::Table& table, Layer& layer) {
    auto bump = scene::held<ParallaxLayer>(layer);
    scene::read_texture_of(table, bump.texture, Content::height);
    scene::read_mapped(table, bump.texture, bump.uv);
    table.choose("mode", bump.mode, {{"offset", ParallaxMode::offset}, {"march", ParallaxMode::march}});
    table.read("steps", bump.steps, 1, 1024);
    table.read("refine", bump.refine, 0, 16);
    for (const char* key : {"steps", "refine"}) table.only_with(key, bump.mode == ParallaxMode::march, "mode", "march");
    table.read("level", bump.level, scene::zero_to_one);
    table.read("curved", bump.curved);
    table.read("scale", layer.scale, {.low = 0, .high = 1e6, .low_is_allowed = false});
    scene::read_place(table, layer);
    layer.bump = bump;
}

double scale(const Layer& layer) { return layer.scale; }

const ParallaxLayer& parallax_of(const Layer& layer) { return std::get<ParallaxLayer>(layer.bump); }

bool on_uv_plane(const Layer& layer) {
    const UvMapping* uv = find_uv(layer);
    return (uv && uv->source == UvSource::aov) ||
           (layer.mask.texture && layer.mask.texture->uv.source == UvSource::aov);
}

/// Whether a layer after this one uses the UV plane, so that it has to move too.
bool moves_uv(const LayerText& at) {
    const std::vector<Layer>& layers = at.emitter.scene.layers;
    return std::any_of(layers.begin() + (&at.layer - layers.data()) + 1, layers.end(), on_uv_plane);
}

/// How far towards the viewer a point may go for a height of 1, as a share of its distance: half way at most.
double farthest(double level) { return 0.5 / std::max(1 - level, 0.5 / kDeepest); }

/// Kernel text of how far along the ray a height of 1 lies in front of a height of 0.
std::string reach_text(Emitter& emitter, const Layer& layer, const std::string& cosine, const std::string& depth,
                       const std::string& distance) {
    const std::string most = emitter.number(
        layer, "farthest", [parallel = emitter.available.camera == CameraKind::parallel](const Layer& l) {
            return parallel ? 20 * kDeepest : farthest(parallax_of(l).level);
        });
    return fmt::format("wr_parallax_reach({}, {}, {})",
                       parallax_of(layer).mode == ParallaxMode::march ? cosine : "(wr_real)(1)", depth,
                       emitter.available.camera == CameraKind::parallel ? fmt::format("(wr_real)({})", most)
                                                                        : fmt::format("{} * {}", distance, most));
}

/// Text that turns n, and projects the screen derivatives onto its new tangent plane.
std::string turn(LayerText& at, bool uv) {
    at.section.reads.insert({"dn_dx", "dn_dy"});
    at.section.writes.insert("n");
    at.section.operations += 90 + (uv ? 2 * kProjection : 0);
    std::string text =
        "        wr_vec3 flat = n, flat_dx = dp_dx, flat_dy = dp_dy;\n"
        "        wr_vec3 turned = wr_parallax_normal(n, dn_dx, dn_dy, wr_scale(pixels, nearer), v);\n"
        "        n = wr_select(active, turned, n);\n"
        "        {\n" +
        derivative_text(at.emitter) +
        "        }\n"
        "        dp_dx = wr_select(active, dp_dx, flat_dx), dp_dy = wr_select(active, dp_dy, flat_dy);\n";
    if (uv)
        text +=
            "        wr_vec2 uv_dx = wr_project_to_texture(flat, flat_dx, flat_dy, uv.dx, uv.dy, dp_dx);\n"
            "        wr_vec2 uv_dy = wr_project_to_texture(flat, flat_dx, flat_dy, uv.dx, uv.dy, dp_dy);\n"
            "        uv.dx = wr_select(active, uv_dx, uv.dx), uv.dy = wr_select(active, uv_dy, uv.dy);\n";
    return text;
}

std::string emit(LayerText& at) {
    const ParallaxLayer& l = parallax_of(at.layer);
    if (!(at.layer.scale > 0 && at.layer.scale <= kDeepest))
        throw Error(fmt::format("{}: scale is {}; the depth of a parallax is above 0 and at most {} metres", at.who,
                                at.layer.scale, kDeepest));
    const bool parallel = at.emitter.available.camera == CameraKind::parallel;
    const bool march = l.mode == ParallaxMode::march, uv = moves_uv(at), planar = l.uv.source == UvSource::planar;
    at.section.reads.insert({"p", "n", "dp_dx", "dp_dy"});
    at.section.writes.insert({"p", "dp_dx", "dp_dy"});
    if (uv) at.section.reads.insert({"uv", "uv_valid"}), at.section.writes.insert("uv");
    at.section.operations += kProjection * (1 + at.layer.footprint + (uv && planar)) + kMove +
                             kHeightSample * (march ? l.steps / 2 + l.refine : 1);

    const std::string name =
        fmt::format("wr_{}{}", march ? "parallax_march" : "height", l.texture.wrap == Wrap::clamp ? "_clamp" : "");
    std::string text = at.located(l.texture, TexelKind::height);
    text += fmt::format("        wr_vec3 v = {};\n", to_viewer_text(at.emitter));
    if (!parallel) text += "        wr_real distance = sqrt(wr_dot(p, p));\n";
    text += fmt::format("        wr_real reach = {};\n", reach_text(at.emitter, at.layer, "wr_dot(n, v)",
                                                                    "m * " + at.number("scale", scale), "distance"));
    const char* project = "wr_project_to_texture(n, dp_dx, dp_dy, {}, {}, v)";
    if (at.layer.footprint || l.curved)
        text += fmt::format("        wr_vec2 pixels = {};\n",
                            fmt::format(fmt::runtime(project), "wr_v2((wr_real)(1), (wr_real)(0))",
                                        "wr_v2((wr_real)(0), (wr_real)(1))"));
    if (at.layer.footprint) text += "        reach *= wr_parallax_weight(reach * sqrt(wr_dot(pixels, pixels)));\n";
    text += "        active = active & (reach > 0);\n        if (wr_any(active)) {\n";
    text += fmt::format("        wr_real lod = {};\n", at.lod("c.dx", "c.dy"));
    const std::string level = at.number("level", [](const Layer& layer) { return parallax_of(layer).level; });
    if (march)
        text += fmt::format(
            "        wr_vec2 range = wr_scale({0}, reach);\n"
            "        int steps = (int){1};\n"
            "        wr_real step = wr_parallax_step(t, range, lod, steps);\n"
            "        wr_real h = {2}(t, c.st, range, {3}, lod, step, steps, (int){4}, active);\n",
            fmt::format(fmt::runtime(project), "c.dx", "c.dy"),
            at.number("steps", [](const Layer& layer) { return static_cast<double>(parallax_of(layer).steps); }), name,
            level,
            at.number("refine", [](const Layer& layer) { return static_cast<double>(parallax_of(layer).refine); }));
    else
        text += fmt::format("        wr_real h = wr_clamp({}(t, c.st, lod));\n", name);
    text += fmt::format("        wr_real nearer = active ? reach * (h - {}) : (wr_real)(0);\n", level);
    if (uv)
        text += fmt::format("        uv.st = wr_add(uv.st, wr_scale({}, nearer));\n",
                            fmt::format(fmt::runtime(project), "uv.dx", "uv.dy"));
    text += parallel ? "        p = wr_fma(v, nearer, p);\n"
                     : "        wr_real k = 1 - nearer / (active ? distance : (wr_real)(1));\n"
                       "        p = wr_scale(p, k);\n";
    if (l.curved)
        text += turn(at, uv);
    else if (!parallel)
        text += std::string("        dp_dx = wr_scale(dp_dx, k), dp_dy = wr_scale(dp_dy, k);\n") +
                (uv ? "        uv.dx = wr_scale(uv.dx, k), uv.dy = wr_scale(uv.dy, k);\n" : "");
    return text + "        }\n";
}

MovedPoint moves(Emitter& emitter, const Layer& layer, bool own_normal) {
    const ParallaxLayer& l = parallax_of(layer);
    const std::string depth = fmt::format("(wr_real)(WR_BIN_BOX_SLACK * {})", emitter.number(layer, "scale", scale));
    const auto way = [&](const char* what, double (*share)(const Layer&), const char* distance) {
        return fmt::format(
            "{} * {}", emitter.number(layer, what, share),
            reach_text(emitter, layer, own_normal ? "fabs(wr_dot(n, v))" : "(wr_real)(0)", depth, distance));
    };
    return {.nearer = way(
                "1 - level", [](const Layer& of) { return 1 - parallax_of(of).level; }, "(distance - nearer)"),
            .farther = way(
                "level", [](const Layer& of) { return parallax_of(of).level; }, "(distance + farther)"),
            .by_normal = own_normal && l.mode == ParallaxMode::march,
            .turns = l.curved};
}

}  // namespace

const LayerKind& layers::parallax() {
    static constexpr LayerKind row{.name = ParallaxLayer::kind,
                                   .read = read,
                                   .emit = emit,
                                   .uses = layers::on_uv,
                                   .once_a_pixel = true,
                                   .moves = moves};
    return row;
}

}  // namespace wrinkle
