#include "io/plane_errors.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "base/names.h"
#include "io/channel_names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

void fail_missing_plane(std::string_view plane, std::span<const std::string> channels,
                        const std::filesystem::path& file, std::span<const std::string> beauty_channels,
                        const std::filesystem::path& beauty_file) {
    constexpr std::string_view of_file = "channel:";
    const auto found = describe_channels(channels);
    if (plane.starts_with(of_file)) {
        plane.remove_prefix(of_file.size());
        if (!beauty_channels.empty()) {
            std::vector<std::string> both(channels.begin(), channels.end());
            both.insert(both.end(), beauty_channels.begin(), beauty_channels.end());
            throw Error(
                fmt::format("{}: no channel \"{}\", here or in {}; nearest: \"{}\"; channels found: {}; in {}: {}",
                            file.string(), plane, beauty_file.string(), nearest_name(plane, both), found,
                            beauty_file.string(), describe_channels(beauty_channels)));
        }
        throw Error(fmt::format("{}: no channel \"{}\"; nearest: \"{}\"; channels found: {}", file.string(), plane,
                                nearest_name(plane, channels), found));
    }
    const auto role = plane.starts_with("crypto.") ? "cryptomatte" : plane.substr(0, plane.find('.'));
    throw Error(
        fmt::format("{}: no channels for the role \"{}\" (plane {}); channels found: {}; name its layer "
                    "with [gbuffer] roles = {{ {} = \"...\" }}",
                    file.string(), role, plane, found, role));
}

void require_whole_ids(std::string_view plane, const ChannelPlace& place, const std::filesystem::path& file) {
    if (!plane.starts_with("crypto.id")) return;
    if (place.half)
        throw Error(
            fmt::format("{}: cryptomatte channel \"{}\" is 16-bit: its ids are lost; render cryptomattes as "
                        "32-bit float",
                        file.string(), place.name));
    if (!place.lossy.empty())
        throw Error(
            fmt::format("{}: cryptomatte channel \"{}\" is compressed by {}, which keeps some of its digits only: "
                        "its ids are lost; write the file with ZIP, ZIPS, RLE or PIZ",
                        file.string(), place.name, place.lossy));
}

}  // namespace wrinkle::io
