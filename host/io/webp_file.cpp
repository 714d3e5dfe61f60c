#include "io/webp_file.h"

#include <fmt/format.h>
#include <webp/decode.h>

#include <cstdint>
#include <memory>

#include "base/limits.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

Image read_webp(const InputFile& file, int channels) {
    const std::string bytes = file.read_all();
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(data, bytes.size(), &features) == VP8_STATUS_OK && features.has_animation != 0)
        throw Error(fmt::format("{}: an animated WebP image; save one of its pictures", file.name()));
    const double texels = double{1} * features.width * features.height;
    check_memory(file.name(), texels * (4 + channels * double{sizeof(float)}),
                 fmt::format("a picture of {} x {}", features.width, features.height));

    Image image{0, 0, channels, {}};
    const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> rgba(
        WebPDecodeRGBA(data, bytes.size(), &image.width, &image.height), &WebPFree);
    if (!rgba) throw Error(fmt::format("{}: the pixels cannot be read: the file is truncated or damaged", file.name()));
    image.texels.reserve(static_cast<std::size_t>(texels) * static_cast<std::size_t>(channels));
    for (int y = image.height - 1; y >= 0; --y)
        for (int x = 0; x < image.width; ++x) {
            const std::uint8_t* texel =
                rgba.get() +
                4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
            for (int c = 0; c < channels; ++c) image.texels.push_back(static_cast<float>(texel[c]) / 255.0f);
        }
    return image;
}

}  // namespace wrinkle::io
