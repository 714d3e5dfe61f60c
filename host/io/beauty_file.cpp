#include "io/beauty_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/names.h"
#include "io/channel_index.h"
#include "io/writer_names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

void require_one_beauty(std::span<const std::string> channels, const std::string& file) {
    const ChannelIndex index(channels);
    const Role colours{"beauty", {"", "", ""}};
    std::vector<std::string> found;
    for (const std::string& layer : index.layers) {
        if (index.match(colours, layer).empty()) continue;
        if (layer.empty()) return;
        const std::string base = layer.substr(layer.rfind('.') + 1);  // npos + 1 is 0
        if (role_of_layer(plain_layer_name(base)) == "beauty") found.push_back(layer);
    }
    if (found.size() > 1)
        throw Error(
            fmt::format("{}: the layers {} could be the beauty; say which, as in beauty = {{ file = \"...\", "
                        "layer = {} }}",
                        file, quote_list(found), quote(found.front())));
}

std::uint32_t beauty_scale(const ImageParts& beauty, const std::filesystem::path& beauty_file, const ImageParts& frame,
                           const std::filesystem::path& frame_file) {
    constexpr std::uint32_t most = 16;
    const std::uint32_t scale = std::max(frame.size.width / std::max(beauty.size.width, 1u), 1u);
    const auto times = static_cast<int>(scale);
    if (scale > most || frame.size.width != scale * beauty.size.width ||
        frame.size.height != scale * beauty.size.height || frame.window.x != times * beauty.window.x ||
        frame.window.y != times * beauty.window.y)
        throw Error(
            fmt::format("{}: the beauty has {}x{} pixels; {} has {}x{}, and must have as many or a whole "
                        "multiple, up to {} along each side",
                        beauty_file.string(), beauty.size.width, beauty.size.height, frame_file.string(),
                        frame.size.width, frame.size.height, most));
    const Size &few = beauty.window.display, &many = frame.window.display;
    if (scale > 1 && (many.width != scale * few.width || many.height != scale * few.height))
        throw Error(fmt::format(
            "{}: the display window of the beauty has {}x{} pixels, and that of {} has {}x{}; with overscan "
            "it must have {} times as many along each side, as the data window has, or PNGs would lose "
            "columns or rows",
            beauty_file.string(), few.width, few.height, frame_file.string(), many.width, many.height, scale));
    return scale;
}

void read_enlarged(BandReader& reader, std::uint32_t row_begin, std::uint32_t row_end,
                   std::span<const WantedChannel> channels, std::size_t width, std::uint32_t scale) {
    const std::uint32_t first = row_begin / scale, end = (row_end + scale - 1) / scale;
    const std::size_t few = width / scale;
    std::vector<std::vector<float>> small(channels.size(), std::vector<float>(few * (end - first)));
    std::vector<WantedChannel> wanted;
    for (std::size_t k = 0; k < channels.size(); ++k)
        wanted.push_back({channels[k].place, small[k].data(), channels[k].bits});
    reader.read(first, end, wanted);
    for (std::size_t k = 0; k < channels.size(); ++k)
        for (std::uint32_t y = row_begin; y < row_end; ++y) {
            const float* const from = small[k].data() + (y / scale - first) * few;
            float* const to = channels[k].out + std::size_t{y - row_begin} * width;
            for (std::size_t x = 0; x < width; ++x) to[x] = from[x / scale];
        }
}

bool is_alpha_beside(const std::string& channel, const std::string& red) {
    const std::string layer = lower(red.substr(0, red.rfind('.') + 1)), name = lower(channel);  // "" of a plain "R"
    return name == layer + "a" || name == layer + "alpha";
}

}  // namespace wrinkle::io
