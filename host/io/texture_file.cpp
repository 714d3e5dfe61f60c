#include "io/texture_file.h"

#include <OpenImageIO/imageio.h>

#include <fmt/format.h>
#include <memory>

#include "base/only_errors.h"
#include "io/image_open.h"
#include "io/reason.h"
#include "io/texture_texels.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

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

TexelSource open_flat(const std::filesystem::path& file) {
    OIIO::ImageSpec options;
    options.attribute("oiio:UnassociatedAlpha", 1);  // else heights of transparent texels would be multiplied by 0
    const auto image = std::make_shared<const io::OpenImage>(file, options);
    const auto& spec = image->input().spec();
    if (spec.deep || spec.depth > 1) throw Error(fmt::format("{}: not a flat image", file.string()));
    return {spec, file.string(), [image, file](int channels) { return read_texels(image->input(), channels, file); }};
}

}  // namespace

Image load_texture(const std::filesystem::path& file, ImageUse use) {
    return only_errors(file.c_str(), [&] { return texture_of(open_flat(file), use); });
}

Image load_slopes(const std::filesystem::path& file, Encoding encoding, SlopeUnit unit) {
    return only_errors(file.c_str(), [&] { return slopes_of(open_flat(file), encoding, unit); });
}

Image load_bump(const TextureUse& use) {
    return only_errors(use.file.c_str(), [&] { return bump_of(open_flat(use.file), use); });
}

}  // namespace wrinkle
