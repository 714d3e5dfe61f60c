#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/names.h"
#include "base/vec.h"
#include "scene/layer_readers.h"
#include "scene/readers.h"

namespace wrinkle::scene {
namespace {

/// "#" and 8 hex digits. Any other text that begins with # is taken for a hash with a slip in it, because a name that
/// matches nothing would quietly mask everything out.
bool is_hash(std::string_view text) {
    return text.size() == 9 &&
           std::all_of(text.begin() + 1, text.end(), [](unsigned char c) { return std::isxdigit(c); });
}

/// What a mask tells by planes of the frame.
void read_planes_of_mask(Table& table, Mask& out) {
    table.read_some("object", out.object);
    if (table.read_some("cryptomatte", out.cryptomatte))
        for (const std::string& name : out.cryptomatte)
            if (name.front() == '#' && !is_hash(name) && !table.is_bad("cryptomatte"))
                table.complain("cryptomatte",
                               fmt::format("is {}; a hash is # and 8 hex digits, such as \"#1a2b3c4d\"", quote(name)));
    table.read("channel", out.channel);
    table.read("invert", out.invert);
}

}  // namespace

void read_uv(Table& table, UvMapping& out) {
    table.choose("source", out.source, {{"aov", UvSource::aov}, {"planar", UvSource::planar}});
    if (table.has("scale") && !table.is_array("scale")) {
        double both = 1;
        if (table.read("scale", both)) out.scale = {both, both};
    } else {
        table.read("scale", out.scale);
    }
    if (out.scale[0] == 0 || out.scale[1] == 0) table.complain("scale", "must not be 0 (negative mirrors)");
    table.read("offset", out.offset);
    table.read_degrees("rotation", out.rotation);
    for (const auto& [key, axis] : {std::pair{"axis_u", &out.axis_u}, std::pair{"axis_v", &out.axis_v}}) {
        table.read(key, *axis);
        table.only_with(key, out.source == UvSource::planar, "source", "planar");
    }
    if (!table.is_bad("axis_u") && !table.is_bad("axis_v") && parallel(out.axis_u, out.axis_v))
        table.complain(table.has("axis_v") ? "axis_v" : "axis_u",
                       "must not make axis_u and axis_v parallel, and neither may be zero");
    table.finish();
}

void read_leave(Table& table, Mask& out) {
    read_planes_of_mask(table, out);
    if (out.texture) table.complain_here(fmt::format("{} must not have a texture", table.where()));
    if (out.object.empty() && out.cryptomatte.empty() && !out.channel)
        table.complain_here(fmt::format("{} needs one of the keys object, cryptomatte, channel", table.where()));
    table.finish();
}

void read_mask(Table& table, Mask& out) {
    read_planes_of_mask(table, out);
    if (table.visits()) table.compiled_in("texture", out.texture.has_value());
    if (out.texture) table.require("texture");
    MaskTexture texture = out.texture.value_or(MaskTexture{});
    TextureUse use{.file = texture.file, .layer = texture.layer, .channels = texture.channels};
    const bool has_texture = read_texture_name(table, use);
    texture.file = use.file, texture.layer = use.layer, texture.channels = use.channels;
    if (auto uv = table.table("uv", "uv of " + table.where(), out.texture.has_value())) {
        read_uv(*uv, texture.uv);
        if (!table.visits() && !table.has("texture"))
            table.complain("uv", "has an effect only with the key \"texture\"");
    }
    span_tiles(table, use, texture.uv);
    if (has_texture) out.texture = texture;
    const auto has = [&](const char* key, bool held) { return table.has(key) || (table.visits() && held); };
    if (!has("object", !out.object.empty()) && !has("cryptomatte", !out.cryptomatte.empty()) &&
        !has("channel", out.channel.has_value()) && !has("texture", out.texture.has_value()))
        table.complain_here(
            fmt::format("{} needs one of the keys object, cryptomatte, channel, texture", table.where()));
    table.finish();
}

}  // namespace wrinkle::scene
