#include "io/channel_names.h"

#include <fmt/format.h>

namespace wrinkle::io {

ChannelName split_channel(std::string_view channel) {
    const auto dot = channel.rfind('.');
    if (dot == std::string_view::npos) return {"", std::string(channel)};
    return {std::string(channel.substr(0, dot)), std::string(channel.substr(dot + 1))};
}

std::string describe_channels(std::span<const std::string> channels) {
    std::vector<ChannelName> layers;  // in the file's order, with the components of a layer joined
    for (const auto& channel : channels) {
        auto name = split_channel(channel);
        const bool groups = !name.layer.empty() && name.component.size() == 1;
        if (groups && !layers.empty() && layers.back().layer == name.layer && layers.back().component.size() < 4) {
            layers.back().component += name.component;
        } else {
            layers.push_back(std::move(name));
        }
    }
    std::string text;
    for (const auto& [layer, component] : layers) {
        text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", layer, layer.empty() ? "" : ".", component);
    }
    return text.empty() ? "none" : text;
}

}  // namespace wrinkle::io
