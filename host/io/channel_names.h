#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Names of channels: taking them apart, and listing them in messages.
namespace wrinkle::io {

/// A channel's layer and component: "ViewLayer.Normal.X" is {"ViewLayer.Normal", "X"}, "Z" is {"", "Z"}.
struct ChannelName {
    std::string layer, component;
};
ChannelName split_channel(std::string_view channel);

/// The channels as people read them: "ViewLayer.Normal.XYZ, ViewLayer.Depth.Z, R, G".
std::string describe_channels(std::span<const std::string> channels);

}  // namespace wrinkle::io
