#include "tools/frame_warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "plan/layer_text.h"
#include "plan/section.h"

namespace wrinkle {

namespace {

bool uses_uv_pass(const Layer& layer) {
    const UvMapping* uv = find_uv(layer);
    const bool own = uv != nullptr && uv->source == UvSource::aov;
    return own || (layer.mask.texture && layer.mask.texture->uv.source == UvSource::aov);
}

/// `type` says how a channel is stored.
std::string problem_of_uv(const RoleMap& roles, const std::function<ChannelType(const std::string&)>& type) {
    const bool derivatives =
        (roles.has_role("duv_dx") && roles.has_role("duv_dy")) || (roles.has_role("dp_du") && roles.has_role("dp_dv"));
    if (!roles.has_role("uv") || derivatives) return {};
    const auto& channel = roles.channel_of.find("uv.u")->second;
    if (type(channel) != ChannelType::half) return {};
    return fmt::format(
        "the UV pass ({}) is 16-bit: its steps from pixel to pixel have too few digits for slopes; render it in 32 "
        "bits, "
        "or render dp_du and dp_dv, or use uv = {{ source = \"planar\" }}",
        channel);
}

}  // namespace

std::string uv_problem(const GBufferInfo& info) {
    return problem_of_uv(info.roles, [&](const std::string& channel) {
        return info.types.at(
            static_cast<std::size_t>(std::ranges::find(info.channels, channel) - info.channels.begin()));
    });
}

std::vector<std::string> frame_warnings(const Scene& scene, const GBufferReader& reader) {
    std::vector<std::string> lines;
    const std::string uv =
        problem_of_uv(reader.roles(), [&](const std::string& channel) { return reader.channel_type(channel); });
    if (const auto layer = std::ranges::find_if(scene.layers, uses_uv_pass); !uv.empty() && layer != scene.layers.end())
        lines.push_back(fmt::format("{}: {}", layer_label(*layer), uv));
    return lines;
}

}  // namespace wrinkle
