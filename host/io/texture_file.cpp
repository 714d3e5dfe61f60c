#include "io/texture_file.h"

#include <OpenImageIO/imageio.h>

#include <fmt/format.h>
#include <algorithm>
#include <memory>

#include "base/limits.h"
#include "base/only_errors.h"
#include "io/image_open.h"
#include "io/image_parts.h"
#include "io/reason.h"
#include "io/texture_channels.h"
#include "io/texture_texels.h"
#include "io/udim.h"
#include "io/webp_file.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

/// The channels of a file that are read: numbers within one of its parts, in the order in which they are wanted.
struct Picked {
    int part = 0;
    std::vector<int> channels;
};

[[noreturn]] void fail_reading(const std::filesystem::path& file, const std::string& message) {
    throw Error(fmt::format("{}: the pixels cannot be read{}: the file is truncated or damaged", file.string(),
                            io::reason(message)));
}

/// Some readers fill what is missing and say so beside returning success.
void check_read(OIIO::ImageInput& input, bool whole, const std::filesystem::path& file) {
    const auto message = input.geterror();
    if (!whole || !message.empty()) fail_reading(file, message);
}

/// Reads the first `count` picked channels of the display window, bottom row first; it is 0 where there is no data.
Image read_texels(OIIO::ImageInput& input, const Picked& picked, int count, const std::filesystem::path& file) {
    const auto spec = input.spec();
    const std::span wanted(picked.channels.data(), static_cast<std::size_t>(count));
    const auto [first, last] = std::ranges::minmax(wanted);
    const bool windowed = spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
                          spec.height != spec.full_height;
    if (!windowed && std::ranges::is_sorted(wanted) && last - first + 1 == count) {  // no second copy
        Image image{spec.width, spec.height, count, {}};
        const auto row = static_cast<std::size_t>(spec.width) * wanted.size();
        image.texels.resize(row * static_cast<std::size_t>(spec.height));
        float* top = image.texels.data() + row * static_cast<std::size_t>(spec.height - 1);
        const bool whole = input.read_image(picked.part, 0, first, last + 1, OIIO::TypeFloat, top, OIIO::AutoStride,
                                            -static_cast<OIIO::stride_t>(row * sizeof(float)));
        check_read(input, whole, file);
        return image;
    }
    const auto read = static_cast<std::size_t>(last - first + 1);
    std::vector<float> data(read * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height));
    const bool whole = input.read_image(picked.part, 0, first, last + 1, OIIO::TypeFloat, data.data());
    check_read(input, whole, file);
    Image image{spec.full_width, spec.full_height, count, {}};
    image.texels.assign(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * wanted.size(),
                        0);
    const int left = spec.x - spec.full_x, top = spec.y - spec.full_y;
    for (int y = std::max(top, 0); y < std::min(top + spec.height, spec.full_height); ++y)
        for (int x = std::max(left, 0); x < std::min(left + spec.width, spec.full_width); ++x) {
            const auto from = (static_cast<std::size_t>(y - top) * static_cast<std::size_t>(spec.width) +
                               static_cast<std::size_t>(x - left)) *
                              read;
            const auto to =
                (static_cast<std::size_t>(spec.full_height - 1 - y) * static_cast<std::size_t>(spec.full_width) +
                 static_cast<std::size_t>(x)) *
                wanted.size();
            for (std::size_t c = 0; c < wanted.size(); ++c)
                image.texels[to + c] = data[from + static_cast<std::size_t>(wanted[c] - first)];
        }
    return image;
}

/// All channels as the file has them, or in an EXR file those of the texture's content.
Picked pick(OIIO::ImageInput& input, const TextureUse& use) {
    const std::string name = use.file.string();
    const bool layered = std::string_view(input.format_name()) == "openexr";
    if (!layered) {
        if (!use.layer.empty() || !use.channels.empty())
            throw Error(fmt::format("{}: layers and channels can only be chosen in EXR files", name));
        Picked all;
        for (int i = 0; i < input.spec().nchannels; ++i) all.channels.push_back(i);
        return all;
    }
    const auto parts = io::list_parts(input, use.file);
    std::vector<std::string> names;
    for (const auto& channel : parts.channels) names.push_back(channel.name);
    Picked picked;
    for (const auto& channel : io::texture_channels(names, use, name)) {
        const auto& place = *std::ranges::find(parts.channels, channel, &io::ChannelPlace::name);
        if (!picked.channels.empty() && place.part != picked.part)
            throw Error(
                fmt::format("{}: channel \"{}\" lies in another part of the file than the others", name, channel));
        picked.part = place.part;
        picked.channels.push_back(place.index);
    }
    return picked;
}

bool is_webp_with_alpha(const OIIO::ImageInput& input) {
    return std::string_view(input.format_name()) == "webp" && input.spec().alpha_channel >= 0;
}

/// The largest number that an integer format stores; 0 for floats.
float largest_stored(OIIO::TypeDesc format) {
    return format == OIIO::TypeUInt8 ? 255.0f : format == OIIO::TypeUInt16 ? 65535.0f : 0.0f;
}

/// Moves what is stored as `zero` to the middle of [0,1].
void centre_on(int zero, float largest, Image& image) {
    const auto middle = static_cast<float>(zero);
    for (float& texel : image.texels) texel = ((texel * largest - middle) / (largest - middle) + 1) / 2;
}

TexelSource open_flat(const TextureUse& use) {
    OIIO::ImageSpec options;
    options.attribute("oiio:UnassociatedAlpha", 1);  // else heights of transparent texels would be multiplied by 0
    const auto opened = std::make_shared<const io::OpenImage>(use.file, options);
    OIIO::ImageInput& input = opened->input();
    const std::string name = use.file.string();
    if (input.spec().deep)
        throw Error(fmt::format("{}: a deep image, with several samples a pixel; flatten it first", name));
    if (input.spec().depth > 1) throw Error(fmt::format("{}: a volume, not a picture", name));
    const Picked picked = pick(input, use);
    if (!input.seek_subimage(picked.part, 0)) fail_reading(use.file, input.geterror());
    const auto& stored = input.spec();
    OIIO::ImageSpec spec(stored.full_width, stored.full_height, static_cast<int>(picked.channels.size()),
                         stored.channelformat(picked.channels.front()));
    spec.channelnames.clear();
    spec.extra_attribs = stored.extra_attribs;
    for (std::size_t i = 0; i < picked.channels.size(); ++i) {
        spec.channelnames.push_back(stored.channelnames[static_cast<std::size_t>(picked.channels[i])]);
        if (picked.channels[i] == stored.alpha_channel) spec.alpha_channel = static_cast<int>(i);
    }
    if (spec.format == OIIO::TypeUInt32)
        throw Error(
            fmt::format("{}: channel \"{}\" holds 32-bit integers, which have no scale as heights or normals; "
                        "save it as floats, or in 8 or 16 bits",
                        name, spec.channelnames.front()));
    // Two channels of a TGA are grey and alpha, which its reader does not say.
    if (std::string_view(input.format_name()) == "targa" && spec.nchannels == 2) spec.alpha_channel = 1;
    const float largest = largest_stored(spec.format);
    const bool centred = use.zero != 0 && use.content != Content::height;
    const auto zero = static_cast<float>(use.zero);
    if (centred && !(zero < largest && zero > largest / 4))
        throw Error(fmt::format("{}: zero = {} is for integers of 8 or 16 bits, and near the middle of theirs{}", name,
                                use.zero, largest > 255 ? ": 32767 or 32768 for 16 bits" : ""));
    const auto read = [opened, picked, file = use.file, zero = centred ? use.zero : 0, largest](int channels) {
        Image image = is_webp_with_alpha(opened->input()) ? io::read_webp(*opened->file(), channels)
                                                          : read_texels(opened->input(), picked, channels, file);
        if (zero != 0) centre_on(zero, largest, image);
        return image;
    };
    return {spec, name, read};
}

TextureUse used_as(const std::filesystem::path& file, ImageUse use) {
    return {.file = file,
            .content = use == ImageUse::normal          ? Content::normal
                       : use == ImageUse::object_normal ? Content::object_normal
                                                        : Content::height};
}

/// A texel where there is no tile: flat.
std::vector<float> flat_texel(Content content, int channels) {
    std::vector<float> texel(static_cast<std::size_t>(channels), 0.0f);
    if (content == Content::normal) texel = {0.5f, 0.5f, 1.0f};
    return texel;
}

/// All tiles of a <UDIM> texture as one image.
Image load_tiles(const TextureUse& use) {
    const auto tiles = io::udim_tiles(use.file);
    if (tiles.empty()) throw Error(fmt::format("{}: there is no tile of it", use.file.string()));
    const io::UdimSpan span = io::udim_span(tiles);
    Image all;
    int width = 0, height = 0;
    for (const auto& tile : tiles) {
        TextureUse one = use;
        one.file = tile.file;
        const Image image = bump_of(open_flat(one), one);
        if (all.texels.empty()) {
            width = image.width, height = image.height;
            const double texels = double{1.0} * width * span.columns * height * span.rows;
            check_memory(use.file.string(), texels * image.channels * sizeof(float),
                         fmt::format("a picture of {} x {} tiles from 1001 on", span.columns, span.rows));
            all = {width * span.columns, height * span.rows, image.channels, {}};
            const auto flat = flat_texel(use.content, image.channels);
            const auto count = static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height);
            all.texels.reserve(count * flat.size());
            for (std::size_t i = 0; i < count; ++i) all.texels.insert(all.texels.end(), flat.begin(), flat.end());
        }
        if (image.width != width || image.height != height)
            throw Error(fmt::format("{}: {} x {} texels; the other tiles have {} x {}", tile.file.string(), image.width,
                                    image.height, width, height));
        if (image.channels != all.channels)
            throw Error(
                fmt::format("{}: {} means of slopes' products, and the first tile {}; have maketx --bumpslopes "
                            "write all tiles alike",
                            tile.file.string(), image.channels == 5 ? "has" : "lacks",
                            image.channels == 5 ? "lacks them" : "has them"));
        // Slopes are per unit of the texture, which now spans more.
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < image.channels; ++c) {
                    const auto column = static_cast<std::size_t>(tile.column * width + x);
                    const auto row = static_cast<std::size_t>(tile.row * height + y);
                    const int of_s[] = {1, 0, 2, 1, 0}, of_t[] = {0, 1, 0, 1, 2};  // powers of the factors
                    int by = 1;
                    for (int k = 0; use.content == Content::slope && k < of_s[c]; ++k) by *= span.columns;
                    for (int k = 0; use.content == Content::slope && k < of_t[c]; ++k) by *= span.rows;
                    all.texels[(row * static_cast<std::size_t>(all.width) + column) *
                                   static_cast<std::size_t>(all.channels) +
                               static_cast<std::size_t>(c)] = static_cast<float>(by) * image.at(x, y, c);
                }
    }
    return all;
}

}  // namespace

Image load_texture(const std::filesystem::path& file, ImageUse use) {
    return only_errors(file.c_str(), [&] { return texture_of(open_flat(used_as(file, use)), use); });
}

Image load_slopes(const std::filesystem::path& file, Encoding encoding, SlopeUnit unit) {
    return only_errors(file.c_str(),
                       [&] { return slopes_of(open_flat({.file = file, .content = Content::slope}), encoding, unit); });
}

Image load_bump(const TextureUse& use) {
    return only_errors(use.file.c_str(),
                       [&] { return io::is_udim(use.file) ? load_tiles(use) : bump_of(open_flat(use), use); });
}

}  // namespace wrinkle
