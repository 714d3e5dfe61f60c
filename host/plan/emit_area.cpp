#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "plan/geometry_text.h"
#include "plan/own_gradient.h"
#include "plan/planned_numbers.h"

namespace wrinkle {

namespace {

/// Text that sets the number of points in each pixel's area.
std::string count_text(Emitter& emitter) {
    const std::size_t most = add_numbers(emitter, "taps of [filter]", [](const NumberSource& source) {
        return std::vector{static_cast<double>(source.scene.filter.taps)};
    });
    return fmt::format("        taps.count = wr_tap_count(taps, (int)numbers[{}], wanted);\n", most);
}

/// Texts that part a pixel's area into shares, and set the position of the point of one.
constexpr const char* kShares = "        const wr_shares shares = wr_shares_of(taps);\n";
constexpr const char* kAxesUv = "        const wr_texcoord axes_uv = wr_along_area(uv, taps);\n";
constexpr const char* kPoint =
    "            const wr_mask on = valid & (taps.count > (wr_real)((WR_SCALAR)tap));\n"
    "            if (!wr_any(on)) break;\n"
    "            wr_real weight, shift = wr_tap_at(taps, shares, tap, &weight);\n"
    "            const wr_real share = on ? weight : (wr_real)(0);\n"
    "            wr_vec3 p = wr_fma(taps.along, shift, centre);\n";
constexpr const char* kPointLow =
    "            wr_vec3 p_low;\n"
    "            p = wr_moved(centre, centre_low, wr_scale(taps.along, shift), &p_low);\n";
/// The same where the pixel's centre is its only point.
constexpr const char* kCentre =
    "            const wr_mask on = valid;\n"
    "            const wr_real share = on ? (wr_real)(1) : (wr_real)(0);\n"
    "            wr_vec3 p = centre;\n";

/// A variable that layers add to, and the one for its mean over the area.
struct Sum {
    const char *value, *name;
};
constexpr Sum kSums[] = {{"g", "sum"}, {"dh_dp", "sum_space"}};

/// Text that declares the sums for the covariance of slopes. Slopes are taken relative to that of the first point, so
/// that a steep mean cancels no digits.
constexpr const char* kSpreadSums =
    "        wr_vec3 right = wr_right_on_surface(n, dp_dx), down = wr_cross_fast(right, n), products = wr_zero3();\n"
    "        wr_vec2 first_slope = {0, 0}, mean_slope = {0, 0};\n";

/// Text that turns those sums into the covariance.
constexpr const char* kSpreadEnd =
    "        wr_vec3 variance = wr_v3(products.x - mean_slope.x * mean_slope.x, products.y - mean_slope.x * "
    "mean_slope.y,\n            products.z - mean_slope.y * mean_slope.y);\n"
    "        spread = wr_add(spread, wr_v3(fmax(variance.x, (wr_real)(0)), variance.y, fmax(variance.z, "
    "(wr_real)(0))));\n";

/// Text that adds the slopes of a point to the sums for their covariance.
constexpr const char* kAddSpread =
    "            if (tap == 0) first_slope = slope;\n"
    "            slope = wr_select(on, wr_sub(slope, first_slope), wr_v2((wr_real)(0), (wr_real)(0)));\n"
    "            mean_slope = wr_v2(fma(slope.x, share, mean_slope.x), fma(slope.y, share, mean_slope.y));\n"
    "            finer = wr_add(finer, wr_v3(slope.x * slope.x, slope.x * slope.y, slope.y * slope.y));\n"
    "            products = wr_select(on, wr_fma(finer, share, products), products);\n";

/// Text that lights a point on several sides of its mean slope, where slopes vary within its share of the area: four,
/// or two at each point of several, which take turns.
constexpr const char* kSides =
    "            const wr_vec3 apart = wr_spread_to_light(finer);\n"
    "            const wr_sides around = wr_sides_of(apart);\n"
    "            const wr_mask varied = on & (apart.x + apart.z > 0), alone = taps.count < 2;\n"
    "            const int sides = wr_any(varied & alone) ? 4 : wr_any(varied) ? 2 : 1;\n"
    "            const wr_real part = share / (wr_real)((WR_SCALAR)sides);\n"
    "#pragma nounroll\n"
    "            for (int side = 0; side < sides; ++side) {\n"
    "            const wr_vec2 tilt = wr_add(slope, wr_side(around, alone ? (wr_real)((WR_SCALAR)side)\n"
    "                                                      : (wr_real)((WR_SCALAR)(2 * (tap & 1) + (side & 1)))));\n"
    "            wr_vec3 bent = wr_resolve_slopes(n, right, down, tilt, lift);\n"
    "            bent = wr_select(wr_sound(bent), bent, n);\n";

/// Text that adds the light on a point to the sums.
std::string add_light_text(const Emitter& emitter) {
    // On one lane found anew at each point: kept through the loop, it would take three registers.
    std::string text =
        fmt::format("            if (WR_LANES == 1) lit_point.v = v = {};\n",
                    to_viewer_text(emitter, "wr_anew(centre, tap)")) +
        kSides + lit_point_text("bent", "wr_widened_roughness(roughness, wr_scale(finer, (wr_real)(WR_LIGHT_SPREAD)))");
    for (const LitTerm& term : lit_terms(emitter))
        text += fmt::format(
            "            wr_vec3 {0}_here = {1};\n"
            "            {0}_sum = wr_select(on, wr_fma({0}_here, part, {0}_sum), {0}_sum);\n",
            term.value, term.of("bent", "lit_point.roughness"));
    return text + "            }\n";
}

}  // namespace

std::string share_text(bool uv, const std::string& tap, const std::string& shift) {
    return fmt::format(
               "        const wr_vec3 dp_dx = wr_share_dx(taps, shares, {0}), dp_dy = wr_anew(taps.across, {0});\n",
               tap) +
           (uv ? fmt::format("        const wr_texcoord uv = wr_share_uv(axes_uv, shares, {}, {});\n", shift, tap)
               : "");
}

std::string axis_text(const Emitter& emitter) {
    std::string right = "(wr_real)(0)", down = right;
    if (emitter.available.camera == CameraKind::pinhole) {
        right = "wr_depth_turn(wr_v3(camera->forward), p, dp_dx)";
        down = "wr_depth_turn(wr_v3(camera->forward), p, dp_dy)";
    }
    return fmt::format("        wr_taps taps = wr_taps_of(dp_dx, dp_dy,\n            {},\n            {});\n", right,
                       down);
}

bool wants_spread(const Emitter& emitter) {
    const Scene& scene = emitter.scene;
    return emitter.options.write_normal && (scene.output.roughness || scene.output.slope_covariance ||
                                            (scene.filter.taps > 1 && scene.lighting.relight != Relight::off));
}

bool walks_area(const Emitter& emitter) {
    return emitter.options.normal && (emitter.scene.filter.taps > 1 || wants_spread(emitter));
}

bool varies_over_area(const Emitter& emitter, const Layer& layer) {
    const LayerKind& kind = emitter.kind(layer);
    if (!walks_area(emitter) || !layer.footprint || kind.once_a_pixel) return false;
    // Tiles cover the areas that the frame's own points and normals give, not those that layers before have moved or
    // bent.
    const auto before = std::span(emitter.scene.layers).first(emitter.index_of(layer));
    return !kind.binned || std::ranges::none_of(before, [&](const Layer& l) {
        return emitter.kind(l).moves || emitter.kind(l).ends_stage;
    });
}

Section emit_area(Emitter& emitter, const std::vector<Section>& sections, const AreaUse& use) {
    Section area;
    area.title = "layers over the pixel's area";
    area.reads = {"valid", "p", "n", "dp_dx", "dp_dy"};
    std::string own_sums, own_stores, masks, before, bumps, wanted;
    for (const Section& section : sections) {
        area.reads.insert(section.reads.begin(), section.reads.end());
        area.writes.insert(section.writes.begin(), section.writes.end());
        area.inputs.insert(section.inputs.begin(), section.inputs.end());
        area.operations += section.operations;
        area.parts.push_back({0, section.title, {section.inputs.begin(), section.inputs.end()}, section.operations});
        area.outputs.insert(area.outputs.end(), section.outputs.begin(), section.outputs.end());
        own_sums += own_sum_text(section);
        own_stores += own_store_text(section);
        masks += section.masks;
        before += section.before;
        wanted += (wanted.empty() ? "" : " | ") + section.wanted;
        bumps += fmt::format("            // {}\n            {{\n{}            }}\n", section.kind, section.body);
    }
    area.reads.insert({"g", "dh_dp"});
    area.operations += 60;
    const bool uv = area.reads.contains("uv"), low = area.reads.contains("p_low"), one = emitter.scene.filter.taps == 1;
    std::string sums;
    for (const Sum& sum : kSums)
        if (area.writes.contains(sum.value)) sums += fmt::format("        wr_vec3 {} = wr_zero3();\n", sum.name);
    if (use.lights) {
        area.reads.insert("base");
        for (const LitTerm& term : lit_terms(emitter)) {
            area.reads.insert(term.value), area.writes.insert(term.value);
            sums += fmt::format("        wr_vec3 {}_sum = wr_zero3();\n", term.value);
        }
        area.operations += 20 + 75 * lights_of_pixel(emitter);
        sums += lit_surface_text(emitter, area);
    }
    if (use.spread) {
        area.reads.insert("spread"), area.writes.insert("spread");
        area.operations += 20;
        sums += kSpreadSums;
    }

    std::string& text = area.body;
    // Groups of pixels that no layer wants skip the section, unless it is the first to light: every pixel needs light.
    const bool all = use.lights && use.first;
    text = own_sums + masks +
           fmt::format("        const wr_mask wanted = {};\n        if ({}) {{\n", wanted,
                       all || !emitter.options.skip ? "1" : "wr_any(wanted)") +
           (one ? "" : axis_text(emitter) + count_text(emitter)) + sums +
           "        const wr_vec3 centre = p, before = g, before_space = dh_dp;\n" + (one ? "" : kShares);
    if (uv && !one) text += kAxesUv;
    if (low) text += "        const wr_vec3 centre_low = p_low;\n";
    text += before;
    text += one ? "        for (int tap = 0; tap < 1; ++tap) {\n"
                : "#pragma nounroll\n        for (int tap = 0;; ++tap) {\n";
    text +=
        (one ? kCentre : kPoint) +
        fmt::format("            wr_vec3 g = before, dh_dp = before_space{};\n            const wr_mask valid = on;\n",
                    use.spread ? ", finer = wr_zero3()" : "");
    if (low) text += one ? "            wr_vec3 p_low = centre_low;\n" : kPointLow;
    text += bumps;
    for (const Sum& sum : kSums)
        if (area.writes.contains(sum.value))
            text +=
                fmt::format("            {0} = wr_select(on, wr_fma({1}, share, {0}), {0});\n", sum.name, sum.value);
    // The axes are orthonormal on the surface, so what a gradient in space has on them is its projection's. Layers that
    // are not projected leave a part along n in g.
    if (use.spread)
        text += fmt::format("            wr_vec2 slope = wr_on_axes({}, right, down);\n",
                            use.space ? "wr_add(g, dh_dp)" : "g");
    if (use.lights) text += "            const wr_real lift = wr_dot(g, n);\n";
    // Here `finer` still holds only how slopes vary within one point's share of the area, and that alone spreads the
    // light on the point; how they vary from point to point is added below.
    if (use.lights) text += add_light_text(emitter);
    if (use.spread) text += kAddSpread;
    text += "        }\n";
    for (const Sum& sum : kSums)
        if (area.writes.contains(sum.value)) text += fmt::format("        {} = {};\n", sum.value, sum.name);
    if (use.spread) text += kSpreadEnd;
    if (use.lights)
        for (const LitTerm& term : lit_terms(emitter))
            text += use.first ? fmt::format("        {0} = {0}_sum;\n", term.value)
                              : fmt::format("        {0} = wr_select(wanted, {0}_sum, {0});\n", term.value);
    text += "        }\n" + own_stores;
    return area;
}

}  // namespace wrinkle
