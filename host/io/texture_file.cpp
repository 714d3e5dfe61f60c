#include "io/texture_file.h"

#include <OpenImageIO/imageio.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "io/image_open.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

void check_channels(const OIIO::ImageSpec& spec, ImageUse use, const std::filesystem::path& file) {
    const int n = spec.nchannels;
    const bool alpha = n == 2 && spec.alpha_channel == 1;  // grey with coverage: one channel of data
    const bool fits = use == ImageUse::scalar ? n == 1 || n >= 3 || alpha : n >= 3 || (n == 2 && !alpha);
    if (fits) return;
    throw Error(fmt::format("{}: has {} channel{}{}; {}", file.string(), n, n == 1 ? "" : "s",
                            alpha ? " (grey and alpha)" : "",
                            use == ImageUse::scalar ? "a height or mask image needs 1, or 3 and more"
                                                    : "a normal map needs 3 (x, y, z) or 2 (x, y); is it a height map? "
                                                      "then use kind = \"height_map\" or content = \"height\""));
}

void check_finite(const Image& image, const std::filesystem::path& file) {
    const auto bad = std::ranges::find_if(image.texels, [](float v) { return !std::isfinite(v); });
    if (bad == image.texels.end()) return;
    const auto texel = (bad - image.texels.begin()) / image.channels;
    throw Error(fmt::format("{}: pixel ({}, {}) from the top left is {}; a bump texture must be finite", file.string(),
                            texel % image.width, image.height - 1 - texel / image.width,
                            std::isnan(*bad) ? "NaN" : "infinite"));
}

/// Reads the first `channels` channels, bottom row first.
Image read_texels(OIIO::ImageInput& input, int channels, const std::filesystem::path& file) {
    const auto& spec = input.spec();
    Image image{spec.width, spec.height, channels, {}};
    const auto row = static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(channels);
    image.texels.resize(row * static_cast<std::size_t>(spec.height));
    const auto stride = static_cast<OIIO::stride_t>(row * sizeof(float));
    float* top = image.texels.data() + row * static_cast<std::size_t>(spec.height - 1);
    if (!input.read_image(0, 0, 0, channels, OIIO::TypeFloat, top, OIIO::AutoStride, -stride)) {
        throw Error(fmt::format("{}: the pixels cannot be read{}: the file is truncated or damaged", file.string(),
                                io::reason(input.geterror())));
    }
    return image;
}

/// Signed to [0,1], and the z of two-channel maps.
Image complete_normals(const Image& read, bool is_float) {
    const auto texels = static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height);
    const auto channels = static_cast<std::size_t>(read.channels);
    bool is_signed = false;
    for (std::size_t i = 0; is_float && i < texels && !is_signed; ++i) {
        is_signed = read.texels[i * channels] < 0 || read.texels[i * channels + 1] < 0;
    }
    if (!is_signed && channels == 3) return read;

    Image image{read.width, read.height, 3, std::vector<float>(texels * 3)};
    for (std::size_t i = 0; i < texels; ++i) {
        float m[3] = {read.texels[i * channels], read.texels[i * channels + 1], 0};
        for (int axis = 0; axis < 2 && !is_signed; ++axis) m[axis] = 2 * m[axis] - 1;
        m[2] = channels == 3 ? read.texels[i * channels + 2] : std::sqrt(std::max(0.0f, 1 - m[0] * m[0] - m[1] * m[1]));
        for (std::size_t axis = 0; axis < 3; ++axis) image.texels[3 * i + axis] = (m[axis] + 1) / 2;
    }
    return image;
}

}  // namespace

Image load_texture(const std::filesystem::path& file, ImageUse use) {
    OIIO::ImageSpec options;
    options.attribute("oiio:UnassociatedAlpha", 1);  // or a transparent texel's height would be multiplied by 0
    const auto input = io::open_image(file, options);
    const auto spec = input->spec();
    if (spec.deep || spec.depth > 1) throw Error(fmt::format("{}: not a flat image", file.string()));
    check_channels(spec, use, file);
    auto image = read_texels(*input, use == ImageUse::scalar ? 1 : std::min(spec.nchannels, 3), file);
    check_finite(image, file);
    return use == ImageUse::scalar ? image : complete_normals(image, spec.format.is_floating_point());
}

}  // namespace wrinkle
