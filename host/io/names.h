#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Names in messages and comparisons: channels of a file, layers, parts.
namespace wrinkle::io {

std::string lower(std::string_view text);

/// `needle` appears in `text`, whatever the case.
bool contains_ignoring_case(std::string_view text, std::string_view needle);

/// A channel's layer and component: "ViewLayer.Normal.X" is {"ViewLayer.Normal", "X"}, "Z" is {"", "Z"}.
struct ChannelName {
    std::string layer, component;
};
ChannelName split_channel(std::string_view channel);

/// The channels as people read them: "ViewLayer.Normal.XYZ, ViewLayer.Depth.Z, R, G".
std::string describe_channels(std::span<const std::string> channels);

/// The candidate that takes the fewest edits to become `name`, whatever the case; empty without candidates.
std::string nearest_name(std::string_view name, std::span<const std::string> candidates);

}  // namespace wrinkle::io
