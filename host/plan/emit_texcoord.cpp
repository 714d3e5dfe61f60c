#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/section.h"

namespace wrinkle {

namespace {

/// The mapping's 2x2 matrix: rotation times scale.
std::array<std::array<double, 2>, 2> uv_matrix(const UvMapping& uv) {
    const double c = std::cos(uv.rotation), s = std::sin(uv.rotation);
    return {{{c * uv.scale[0], -s * uv.scale[1]}, {s * uv.scale[0], c * uv.scale[1]}}};
}

}  // namespace

std::string emit_texcoord(Emitter& emitter, const UvMapping& uv, Wrap wrap, const std::string& who, Section& section) {
    const auto m = uv_matrix(uv);
    if (uv.source == UvSource::aov) {
        emitter.need(who, {"uv.u", "uv.v"});
        section.reads.insert({"uv", "uv_valid"});
        section.operations += 12;
        if (m[0][0] == 1 && m[1][1] == 1 && m[0][1] == 0 && uv.offset == std::array<double, 2>{})
            return "        wr_texcoord c = uv;\n";
        return fmt::format("        wr_texcoord c = wr_transform(uv, {}, {}, {}, {}, {}, {});\n", literal(m[0][0]),
                           literal(m[0][1]), literal(m[1][0]), literal(m[1][1]), literal(uv.offset[0]),
                           literal(uv.offset[1]));
    }
    section.reads.insert({"p", "dp_dx", "dp_dy"});
    section.operations += 36;
    Vec3 s{}, t{};
    for (std::size_t k = 0; k < 3; ++k) {
        s[k] = m[0][0] * uv.axis_u[k] + m[0][1] * uv.axis_v[k];
        t[k] = m[1][0] * uv.axis_u[k] + m[1][1] * uv.axis_v[k];
    }
    const std::size_t origin = emitter.origin({.axes = {s, t, Vec3{}},
                                               .offset = {uv.offset[0], uv.offset[1], 0},
                                               .period = wrap == Wrap::repeat ? 1.0 : 0.0});
    return fmt::format("        wr_texcoord c = wr_planar(p, dp_dx, dp_dy, {}, {}, origins[{}], origins[{}]);\n",
                       literal(s), literal(t), 4 * origin, 4 * origin + 1);
}

namespace {

/// Kernel text that sets `m` to the product of what planes say of a mask.
std::string mask_of_planes(Emitter& emitter, const Layer& layer, Section& section) {
    const std::string who = layer_label(layer) + ": its mask";
    const Mask& mask = layer.mask;
    std::string text = "        wr_real m = 1;\n";
    const auto factor = [&](const std::string& value) {
        text += fmt::format("        m *= {};\n", value);
        section.operations += 2;
    };
    if (mask.object) {
        emitter.need(who, {"object"});
        section.inputs.insert("object");
        factor(fmt::format("wr_mask_object(wr_load(in_object, at.in), {})", literal(*mask.object)));
    }
    if (mask.cryptomatte) {
        emitter.need(who, {"crypto.id0", "crypto.coverage0"});
        text += "        wr_real covered = 0;\n";
        for (int rank = 0; emitter.has(fmt::format("crypto.id{}", rank)); ++rank) {
            const std::string id = fmt::format("crypto.id{}", rank), coverage = fmt::format("crypto.coverage{}", rank);
            section.inputs.insert({id, coverage});
            text += fmt::format(
                "        covered += wr_mask_cryptomatte(wr_load_floats({}, at.in), wr_load({}, at.in), {}u);\n",
                identifier(id), identifier(coverage), emitter.cryptomatte_hash(*mask.cryptomatte, who));
            section.operations += 3;
        }
        factor("wr_mask_channel(covered)");
    }
    if (mask.channel) {
        const std::string plane = "channel:" + *mask.channel;
        emitter.need(who, {plane});
        section.inputs.insert(plane);
        factor(fmt::format("wr_mask_channel(wr_load({}, at.in))", identifier(plane)));
    }
    return text;
}

}  // namespace

std::string emit_wanted(Emitter& emitter, const std::vector<const Layer*>& layers, Section& section) {
    const auto anywhere = [](const Layer* layer) {
        const Mask& mask = layer->mask;
        return !(mask.object || mask.cryptomatte || mask.channel) || (mask.texture && mask.invert);
    };
    if (std::ranges::any_of(layers, anywhere)) return {};
    std::string text = "        wr_mask wanted = 0;\n";
    for (const Layer* layer : layers) {
        text += "        {\n" + mask_of_planes(emitter, *layer, section) +
                (layer->mask.invert ? "        m = 1 - m;\n" : "") + "        wanted = wanted | (m != 0);\n        }\n";
    }
    return text;
}

std::string emit_mask(Emitter& emitter, const Layer& layer, Section& section) {
    const std::string who = layer_label(layer) + ": its mask";
    const Mask& mask = layer.mask;
    std::string text = mask_of_planes(emitter, layer, section);
    if (mask.texture) {
        const std::size_t number = emitter.texture({.file = mask.texture->file}, TexelKind::mask);
        text += "        {\n" + emit_texcoord(emitter, mask.texture->uv, Wrap::repeat, who, section);
        text += fmt::format(
            "        wr_texture t = wr_texture_at(texels, textures, {});\n"
            "        m *= wr_mask_channel(wr_texture_sample1(t, wr_repeat(c.st.x), wr_repeat(c.st.y), {}));\n        "
            "}}\n",
            number, layer.footprint ? "wr_texture_lod(t, c.dx, c.dy)" : "(wr_real)(0)");
        section.operations += 60;
    }
    if (mask.invert) text += "        m = 1 - m;\n";
    if (mask.texture && mask.texture->uv.source == UvSource::aov)  // after the inversion: unknown is not "outside"
        text += "        m = uv_valid ? m : (wr_real)(0);\n";
    if (mask.channel && mask.invert) {
        const std::string value = fmt::format("wr_load({}, at.in)", identifier("channel:" + *mask.channel));
        text += fmt::format("        m = {0} == {0} ? m : (wr_real)(0);\n", value);
    }
    section.reads.insert("valid");
    text += "        wr_mask active = valid & (m != 0);\n";
    return text;
}

}  // namespace wrinkle
