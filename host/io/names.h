#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Names of channels, layers and parts: taking them apart, comparing them, showing them in messages.
namespace wrinkle::io {

std::string lower(std::string_view text);

/// Whether `text` contains `needle`, in upper or lower case.
bool contains_ignoring_case(std::string_view text, std::string_view needle);

/// A channel's layer and component: "ViewLayer.Normal.X" is {"ViewLayer.Normal", "X"}, "Z" is {"", "Z"}.
struct ChannelName {
    std::string layer, component;
};
ChannelName split_channel(std::string_view channel);

/// The channels as people read them: "ViewLayer.Normal.XYZ, ViewLayer.Depth.Z, R, G".
std::string describe_channels(std::span<const std::string> channels);

/// The candidate that needs the fewest edits to become `name`, where case does not count. Empty without candidates.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace wrinkle::io
