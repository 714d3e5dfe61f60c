#include "io/sky_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/image_open.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

/// The places of red, green and blue among the channels.
std::array<int, 3> colours(const OIIO::ImageSpec& spec, const std::string& file) {
    std::array<int, 3> places{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
    if (std::ranges::min(places) < 0)
        throw Error(fmt::format("{}: is no picture of a sky: it has no channels R, G and B", file));
    return places;
}

void check(const OIIO::ImageSpec& spec, const std::string& file) {
    if (!spec.format.is_floating_point())
        throw Error(
            fmt::format("{}: holds integers, which are colours for a display; a sky has to be light, in EXR or "
                        "Radiance's HDR",
                        file));
    if (spec.width != 2 * spec.height || spec.height < 1)
        throw Error(fmt::format(
            "{}: is {} x {}; a picture of all directions, by longitude and latitude, is twice as wide as high", file,
            spec.width, spec.height));
}

/// Reads rows [y, end) of a picture, all channels as floats.
bool read_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int y, int end, float* out) {
    if (spec.tile_width == 0)
        return input.read_scanlines(0, 0, spec.y + y, spec.y + end, spec.z, 0, spec.nchannels, OIIO::TypeFloat, out);
    return input.read_tiles(0, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + end, spec.z, spec.z + 1, 0,
                            spec.nchannels, OIIO::TypeFloat, out);
}

}  // namespace

void read_sky(const std::filesystem::path& file, const std::function<void(const SkyRow&)>& use) {
    const OpenImage image(file);
    const OIIO::ImageSpec spec = image.input().spec();
    const std::string name = file.string();
    check(spec, name);
    const std::array<int, 3> places = colours(spec, name);
    const auto width = static_cast<std::size_t>(spec.width), channels = static_cast<std::size_t>(spec.nchannels);
    const int rows = spec.tile_width == 0 ? 1 : std::min(spec.tile_height, spec.height);
    std::vector<float> strip(width * channels * static_cast<std::size_t>(rows)), rgb(3 * width);
    for (int y = 0; y < spec.height; ++y) {
        if (y % rows == 0 && !read_rows(image.input(), spec, y, std::min(y + rows, spec.height), strip.data()))
            throw Error(fmt::format("{}: cannot be read from row {} on: {}", name, y, image.input().geterror()));
        const float* const row = strip.data() + static_cast<std::size_t>(y % rows) * width * channels;
        for (std::size_t i = 0; i < 3 * width; ++i) {
            rgb[i] = row[i / 3 * channels + static_cast<std::size_t>(places[i % 3])];
            if (!(rgb[i] >= 0 && rgb[i] <= 3e38F))
                throw Error(
                    fmt::format("{}: pixel ({}, {}) is {}; light is 0 or a positive number", name, i / 3, y, rgb[i]));
        }
        use({y, spec.width, spec.height, rgb});
    }
}

}  // namespace wrinkle::io
