#include "io/vector_planes.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "io/channel_index.h"
#include "io/channel_names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// The channels of the layer of that name, or of the one whose name ends so: "gradient" is "ViewLayer.gradient", too.
std::vector<std::string> channels_of_layer(std::span<const std::string> channels, const std::string& name) {
    const ChannelIndex index(channels);
    const Role vector{"normal", {"", "", ""}};
    std::vector<std::string> vectors, found;
    for (const std::string& layer : index.layers) {
        if (index.match(vector, layer).empty()) continue;
        vectors.push_back(layer);
        if (layer == name) return index.match(vector, layer);
        if (layer.ends_with("." + name)) found.push_back(layer);
    }
    if (found.size() == 1) return index.match(vector, found.front());
    if (!found.empty())
        throw Error(fmt::format("layers that are called {} are {}; say which", quote(name), quote_list(found)));
    throw Error(
        fmt::format("no layer {} of X, Y and Z{}; channels found: {}; name one with layer = \"...\", or three "
                    "channels with channels = [\"...\", \"...\", \"...\"]",
                    quote(name), did_you_mean(name, vectors), describe_channels(channels)));
}

/// The parts of another file, in the frame's view if it has that.
ImageParts parts_of(OIIO::ImageInput& input, const std::filesystem::path& file, const std::string& view,
                    bool overscan) {
    ImageParts parts = list_parts(input, file, {.overscan = overscan});
    const auto same = [&](const std::string& name) { return lower(name) == lower(view); };
    if (!std::ranges::any_of(parts.views, same)) return parts;
    return list_parts(input, file, {.view = view, .overscan = overscan});
}

void require_same_pixels(const ImageParts& frame, const std::filesystem::path& frame_file, const ImageParts& other) {
    if (other.size == frame.size && other.window.x == frame.window.x && other.window.y == frame.window.y) return;
    throw Error(fmt::format("it has {}x{} pixels; {} has {}x{}", other.size.width, other.size.height,
                            frame_file.string(), frame.size.width, frame.size.height));
}

}  // namespace

std::array<std::string, 3> vector_channels(std::span<const std::string> channels, const VectorSource& source) {
    const std::vector<std::string> wanted =
        source.channels.empty() ? channels_of_layer(channels, source.layer) : source.channels;
    for (const std::string& channel : wanted)
        if (std::ranges::find(channels, channel) == channels.end())
            throw Error(fmt::format("no channel {}{}; channels found: {}", quote(channel),
                                    did_you_mean(channel, channels), describe_channels(channels)));
    return {wanted.at(0), wanted.at(1), wanted.at(2)};
}

VectorPlanes::VectorPlanes(const VectorSource& source, const ImageParts& frame, const std::filesystem::path& frame_file,
                           bool overscan)
    : camera_space_(source.camera_space) {
    const std::filesystem::path& file = source.file.empty() ? frame_file : source.file;
    std::optional<OpenImage> opened;  // its own errors name the file
    std::optional<ImageParts> other;
    if (!source.file.empty()) {
        opened.emplace(file);
        other = parts_of(opened->input(), file, frame.view, overscan);
    }
    try {
        if (other) require_same_pixels(frame, frame_file, *other);
        const std::vector<ChannelPlace>& there = other ? other->channels : frame.channels;
        std::vector<std::string> names;
        for (const ChannelPlace& place : there) names.push_back(place.name);
        const auto wanted = vector_channels(names, source);
        for (std::size_t axis = 0; axis < wanted.size(); ++axis)
            places_[axis] = *std::ranges::find(there, wanted[axis], &ChannelPlace::name);
    } catch (const Error& error) { throw Error(fmt::format("{}: {}", file.string(), error.what())); }
    if (other) reader_ = std::make_unique<BandReader>(std::move(*opened), *other);
}

std::optional<std::array<std::span<float>, 3>> vector_memory(const std::string& name,
                                                             std::span<const std::string> planes,
                                                             std::span<float* const> out, std::size_t count,
                                                             const std::filesystem::path& file) {
    std::array<std::span<float>, 3> axes;
    std::size_t given = 0;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
        const auto found = std::ranges::find(planes, name + "." + "xyz"[axis]);
        if (found == planes.end()) continue;
        axes[axis] = {out[static_cast<std::size_t>(found - planes.begin())], count};
        ++given;
    }
    if (given == 0) return std::nullopt;
    if (given == axes.size()) return axes;
    throw Error(fmt::format("{}: {}s can only be read as x, y and z together", file.string(), name));
}

}  // namespace wrinkle::io
