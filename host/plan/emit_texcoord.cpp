#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/mask_text.h"

namespace wrinkle {

namespace {

/// The mapping's 2x2 matrix: rotation times scale.
std::array<std::array<double, 2>, 2> uv_matrix(const UvMapping& uv) {
    const double c = std::cos(uv.rotation), s = std::sin(uv.rotation);
    return {{{c * uv.scale[0], -s * uv.scale[1]}, {s * uv.scale[0], c * uv.scale[1]}}};
}

/// World to texture space: the gradients of s and of t.
std::array<Vec3, 2> planar_rows(const UvMapping& uv) {
    const auto m = uv_matrix(uv);
    std::array<Vec3, 2> rows{};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t k = 0; k < 3; ++k) rows[i][k] = m[i][0] * uv.axis_u[k] + m[i][1] * uv.axis_v[k];
    return rows;
}

}  // namespace

std::string emit_texcoord(Emitter& emitter, const Layer& layer, const UvOf& uv_of, Wrap wrap, const std::string& who,
                          Section& section) {
    if (uv_of(layer).source == UvSource::aov) {
        emitter.need(who, {"uv.u", "uv.v"});
        section.reads.insert({"uv", "uv_valid"});
        section.operations += 12;
        const std::size_t first = emitter.numbers(layer, "uv matrix and offset", [uv_of](const Layer& l, const auto&) {
            const UvMapping& uv = uv_of(l);
            const auto m = uv_matrix(uv);
            return std::vector{m[0][0], m[0][1], m[1][0], m[1][1], uv.offset[0], uv.offset[1]};
        });
        return fmt::format(
            "        wr_texcoord c = wr_transform(uv, numbers[{}], numbers[{}], numbers[{}], numbers[{}], numbers[{}], "
            "numbers[{}]);\n",
            first, first + 1, first + 2, first + 3, first + 4, first + 5);
    }
    section.reads.insert({"p", "dp_dx", "dp_dy"});
    section.operations += 36;
    const std::size_t origin = emitter.eye_place(layer, [uv_of, wrap](const Layer& l) {
        const UvMapping& uv = uv_of(l);
        const auto rows = planar_rows(uv);
        return EyePlace{.axes = {rows[0], rows[1], Vec3{}},
                        .offset = {uv.offset[0], uv.offset[1], 0},
                        .period = wrap == Wrap::repeat ? 1.0 : 0.0};
    });
    const std::string s = emitter.vector(layer, "ds/dp", [uv_of](const Layer& l) { return planar_rows(uv_of(l))[0]; });
    const std::string t = emitter.vector(layer, "dt/dp", [uv_of](const Layer& l) { return planar_rows(uv_of(l))[1]; });
    return fmt::format("        wr_texcoord c = wr_planar(p, dp_dx, dp_dy, {}, {}, eye_places[{}], eye_places[{}]);\n",
                       s, t, 4 * origin, 4 * origin + 1);
}

namespace {

/// Whether a layer may be anywhere, because no plane tells where its mask is 0.
bool anywhere(const Layer* layer) {
    const Mask& mask = layer->mask;
    return (mask.object.empty() && mask.cryptomatte.empty() && !mask.channel) || (mask.texture && mask.invert);
}

}  // namespace

std::string emit_wanted(Emitter& emitter, const std::vector<const Layer*>& layers, Section& section) {
    if (std::ranges::any_of(layers, anywhere)) return {};
    std::string text = "        wr_mask wanted = 0;\n";
    for (const Layer* layer : layers) {
        text += "        {\n" + mask_of_planes(emitter, mask_of_layer(emitter, *layer), section) +
                (layer->mask.invert ? "        m = 1 - m;\n" : "") + "        wanted = wanted | (m != 0);\n        }\n";
    }
    return text;
}

MaskText emit_mask_parts(Emitter& emitter, const Layer& layer, Section& section) {
    const std::string who = layer_label(layer) + ": its mask";
    const Mask& mask = layer.mask;
    const std::string planes = mask_of_planes(emitter, mask_of_layer(emitter, layer), section);
    std::string text;
    if (mask.texture) {
        const std::size_t number = emitter.texture(
            {.file = mask.texture->file, .layer = mask.texture->layer, .channels = mask.texture->channels},
            TexelKind::mask);
        text += "        {\n" + emit_texcoord(
                                    emitter, layer,
                                    [](const Layer& l) -> const UvMapping& { return l.mask.texture.value().uv; },
                                    Wrap::repeat, who, section);
        text += fmt::format(
            "        wr_texture t = wr_texture_at(texels, textures, {});\n"
            "        m *= wr_mask_channel(wr_texture_sample1(t, wr_repeat(c.st.x), wr_repeat(c.st.y), {}));\n        "
            "}}\n",
            number, layer.footprint ? "wr_filter_lod(t, c.dx, c.dy)" : "(wr_real)(0)");
        section.operations += 60;
    }
    if (mask.invert) text += "        m = 1 - m;\n";
    if (mask.texture && mask.texture->uv.source == UvSource::aov)  // after the inversion, which would make 1 of it
        text += "        m = uv_valid ? m : (wr_real)(0);\n";
    if (mask.channel && mask.invert) {
        const std::string value = fmt::format("wr_load({}, at.in)", identifier("channel:" + *mask.channel));
        text += fmt::format("        m = {0} == {0} ? m : (wr_real)(0);\n", value);
    }
    section.reads.insert("valid");
    text += "        wr_mask active = valid & (m != 0);\n";
    return {planes, text, anywhere(&layer)};
}

}  // namespace wrinkle
