#include "io/texture_texels.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "io/packed_normals.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

void check_channels(const OIIO::ImageSpec& spec, ImageUse use, const std::string& name) {
    const int n = spec.nchannels;
    const bool alpha = n == 2 && spec.alpha_channel == 1;  // grey and alpha: only one channel of data
    const bool fits = use == ImageUse::scalar          ? n == 1 || n >= 3 || alpha
                      : use == ImageUse::object_normal ? n >= 3
                                                       : n >= 3 || (n == 2 && !alpha);
    if (fits) return;
    if (use == ImageUse::object_normal)
        throw Error(fmt::format("{}: has {} channel{}; an object-space normal map needs 3 (x, y, z)", name, n,
                                n == 1 ? "" : "s"));
    throw Error(fmt::format("{}: has {} channel{}{}; {}", name, n, n == 1 ? "" : "s", alpha ? " (grey and alpha)" : "",
                            use == ImageUse::scalar ? "a height or mask image needs 1, or 3 and more"
                                                    : "a normal map needs 3 (x, y, z) or 2 (x, y); is it a height map? "
                                                      "then use kind = \"height_map\" or content = \"height\""));
}

void check_finite(const Image& image, const std::string& name) {
    const auto bad = std::ranges::find_if(image.texels, [](float v) { return !std::isfinite(v); });
    if (bad == image.texels.end()) return;
    const auto texel = (bad - image.texels.begin()) / image.channels;
    throw Error(fmt::format("{}: pixel ({}, {}) from the top left is {}; a bump texture must be finite", name,
                            texel % image.width, image.height - 1 - texel / image.width,
                            std::isnan(*bad) ? "NaN" : "infinite"));
}

/// Whether numbers of this type can be negative: floats, and signed integers, which are read as [-1,1].
bool holds_signs(OIIO::TypeDesc format) { return format.is_floating_point() || format.is_signed(); }

/// Whether a file of signed numbers stores its normals as (n + 1) / 2, by a majority of texels. A texel counts for it
/// when unpacking brings its length nearer to 1; of two channels, when the unpacked ones fit into a unit vector. A
/// majority, since resizing a packed file may leave a few texels outside of [0,1].
bool mostly_packed(const Image& read) {
    const auto channels = static_cast<std::size_t>(read.channels);
    std::size_t packed = 0;
    for (std::size_t i = 0; i < read.texels.size(); i += channels) {
        const float* m = &read.texels[i];
        const float x = 2 * m[0] - 1, y = 2 * m[1] - 1;
        if (channels == 3)
            packed += std::abs(std::hypot(x, y, 2 * m[2] - 1) - 1) < std::abs(std::hypot(m[0], m[1], m[2]) - 1);
        else
            packed += x * x + y * y <= 1;
    }
    return 2 * packed >= read.texels.size() / channels;
}

/// Normals of three channels in [0,1], from signed ones and from files that have no z.
Image complete_normals(const Image& read, bool may_be_signed) {
    const auto texels = static_cast<std::size_t>(read.width) * static_cast<std::size_t>(read.height);
    const auto channels = static_cast<std::size_t>(read.channels);
    const bool is_signed = may_be_signed && !mostly_packed(read);
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

/// Vectors, from files that hold them as they are or as (v + 1) / 2.
Image unpacked_vectors(Image image, bool may_be_signed) {
    constexpr float shortest = 0.125f;
    const std::size_t texels = image.texels.size() / 3;
    std::vector<float> axis[3];
    for (std::size_t i = 0; i < image.texels.size(); ++i) axis[i % 3].push_back(image.texels[i]);
    if (may_be_signed && !io::looks_packed(axis[0], axis[1], axis[2])) return image;
    for (std::size_t i = 0; i < texels; ++i) {
        float v[3] = {2 * axis[0][i] - 1, 2 * axis[1][i] - 1, 2 * axis[2][i] - 1};
        const bool none = !may_be_signed && std::hypot(v[0], v[1], v[2]) < shortest;
        for (std::size_t k = 0; k < 3; ++k) image.texels[3 * i + k] = none ? 0 : v[k];
    }
    return image;
}

/// In which channels a file holds its two slopes, and the factors that make them slopes per unit of texture coordinate.
struct SlopeLayout {
    int s_channel = 0, t_channel = 1;
    float s_factor = 1, t_factor = 1;
    bool packed = false;                      ///< a slope is stored as (slope + 1) / 2, before these factors
    bool bumpslopes = false;                  ///< written by maketx --bumpslopes, with heights in channel 0
    std::array<int, 3> products{-1, -1, -1};  ///< channels of the means of dh/ds^2, dh/ds dh/dt, dh/dt^2; -1: none
};

SlopeLayout slope_layout(const OIIO::ImageSpec& spec, Encoding encoding, SlopeUnit unit, const std::string& name) {
    const auto width = static_cast<float>(spec.width), height = static_cast<float>(spec.height);
    const auto channel = [&](const char* channel_name) {
        return static_cast<int>(std::ranges::find(spec.channelnames, channel_name) - spec.channelnames.begin());
    };
    const int n = spec.nchannels, s = channel("b1_dhds"), t = channel("b2_dhdt");
    if (s < n && t < n && unit == SlopeUnit::metre)
        throw Error(fmt::format(
            "{}: its slopes, of maketx --bumpslopes, are per texture; those of decals are metres over metres. "
            "Use its heights, which are in its first channel: content = \"height\"",
            name));
    if (s < n && t < n) {  // t of these files points down, hence the minus
        const float scale = spec.get_float_attribute("uvslopes_scale");
        SlopeLayout at =
            scale == 0 ? SlopeLayout{s, t, width, -height, false, true} : SlopeLayout{s, t, scale, -scale, false, true};
        const std::array products{channel("b3_dhds2"), channel("b5_dh2dsdt"), channel("b4_dhdt2")};
        if (std::ranges::all_of(products, [n](int c) { return c < n; })) at.products = products;
        return at;
    }
    const bool alpha = n == 2 && spec.alpha_channel == 1;
    if (n < 2 || alpha || n == 6)
        throw Error(
            fmt::format("{}: has {} channel{}{}; a derivative map needs 2, or 3 and more of which the first 2 "
                        "count{}",
                        name, n, n == 1 ? "" : "s", alpha ? " (grey and alpha)" : "",
                        n == 6 ? "; is it of maketx --bumpslopes? its channel names (b1_dhds ...) were lost: "
                                 "have it write .exr"
                               : ""));
    SlopeLayout layout;
    layout.packed = encoding == Encoding::unit || (encoding == Encoding::automatic && !holds_signs(spec.format));
    if (unit == SlopeUnit::texel) layout.s_factor = width, layout.t_factor = height;
    return layout;
}

/// A mean square is at least the square of the mean, but for what lossy compression leaves of both.
void check_products(const Image& read, const SlopeLayout& at, const std::string& name) {
    constexpr float kLoss = 0.05F, kSmallest = 2e-7F;
    constexpr int kMost = 16;  // texels that may be the compression's doing
    int wrong = 0;
    std::string first;
    const auto check = [&](int x, int y, int mean, int square, const char* channel) {
        const float slope = read.at(x, y, mean), found = read.at(x, y, square);
        if (found >= slope * slope * (1 - kLoss) - kSmallest) return;
        if (first.empty())
            first = fmt::format(
                "pixel ({}, {}) from the top left has {:.6g} in {}; that is the mean of the squares of "
                "slopes whose mean is {:.6g}, so at least {:.6g}",
                x, read.height - 1 - y, found, channel, slope, slope * slope);
        if (++wrong > kMost || found < -kSmallest)
            throw Error(fmt::format("{}: {}: have maketx --bumpslopes write the file anew", name, first));
    };
    for (int y = 0; y < read.height; ++y)
        for (int x = 0; x < read.width; ++x) {
            check(x, y, at.s_channel, at.products[0], "b3_dhds2");
            check(x, y, at.t_channel, at.products[2], "b4_dhdt2");
        }
}

}  // namespace

Image texture_of(const TexelSource& source, ImageUse use) {
    const OIIO::ImageSpec& spec = source.spec;
    check_channels(spec, use, source.name);
    const bool may_be_signed = holds_signs(spec.format);
    auto image = source.read(use == ImageUse::scalar ? 1 : std::min(spec.nchannels, 3));
    check_finite(image, source.name);
    if (use == ImageUse::object_normal) return unpacked_vectors(std::move(image), may_be_signed);
    return use == ImageUse::scalar ? image : complete_normals(image, may_be_signed);
}

Image slopes_of(const TexelSource& source, Encoding encoding, SlopeUnit unit) {
    SlopeLayout at = slope_layout(source.spec, encoding, unit, source.name);
    const bool products = at.products[0] >= 0;
    const Image read = source.read(std::max({at.s_channel, at.t_channel, std::ranges::max(at.products)}) + 1);
    // A file that maketx made from a normal map has -1 for all its heights, and its t points up.
    if (at.bumpslopes) {
        bool normals = true;
        for (int y = 0; y < read.height; ++y)
            for (int x = 0; x < read.width; ++x) normals = normals && read.at(x, y, 0) == -1;
        if (normals) at.t_factor = -at.t_factor;
    }
    const std::array factors{at.s_factor * at.s_factor, at.s_factor * at.t_factor, at.t_factor * at.t_factor};
    Image slopes{read.width, read.height, products ? 5 : 2, {}};
    for (int y = 0; y < read.height; ++y)
        for (int x = 0; x < read.width; ++x) {
            const auto slope = [&](int channel) {
                const float texel = read.at(x, y, channel);
                return at.packed ? 2 * texel - 1 : texel;
            };
            slopes.texels.push_back(at.s_factor * slope(at.s_channel));
            slopes.texels.push_back(at.t_factor * slope(at.t_channel));
            for (std::size_t k = 0; products && k < 3; ++k)
                slopes.texels.push_back(factors[k] * read.at(x, y, at.products[k]));
        }
    check_finite(slopes, source.name);
    if (products) check_products(read, at, source.name);
    return slopes;
}

Image bump_of(const TexelSource& source, const TextureUse& use) {
    switch (use.content) {
        case Content::height:
            break;
        case Content::normal:
            return texture_of(source, ImageUse::normal);
        case Content::object_normal:
            return texture_of(source, ImageUse::object_normal);
        case Content::slope:
            return slopes_of(source, use.encoding, use.unit);
    }
    return texture_of(source, ImageUse::scalar);
}

}  // namespace wrinkle
