#include "io/texture_doubts.h"

#include <OpenImageIO/imageio.h>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/median.h"
#include "io/image_open.h"
#include "io/udim.h"

namespace wrinkle::io {
namespace {

constexpr std::size_t kMostTexels = std::size_t{1} << 14;  // that are looked at, spread evenly
constexpr int kRows = 64;                                  // of a picture that may be in colour

/// The inverse of sRGB's curve.
double linear(double stored) { return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4); }

/// What the lengths and directions of a map's vectors say of it.
struct Vectors {
    std::vector<double> off, off_if_decoded;    ///< from unit length, as they are and with sRGB's curve undone
    std::array<std::vector<double>, 2> stored;  ///< x and y in [0,1]
    std::size_t below = 0;                      ///< the surface

    void add(const std::array<double, 3>& texel) {
        const auto length = [&](const auto& value) {
            return std::hypot(2 * value(texel[0]) - 1, 2 * value(texel[1]) - 1, 2 * value(texel[2]) - 1);
        };
        off.push_back(std::abs(length([](double v) { return v; }) - 1));
        off_if_decoded.push_back(std::abs(length(linear) - 1));
        stored[0].push_back(texel[0]), stored[1].push_back(texel[1]);
        below += texel[2] < 0.45;
    }
};

Vectors vectors_of(const Image& image, bool packed) {
    Vectors seen;
    const std::size_t texels = image.texels.size() / 3, step = std::max<std::size_t>(texels / kMostTexels, 1);
    for (std::size_t i = 0; i < texels; i += step) {
        std::array<double, 3> texel{};
        for (std::size_t k = 0; k < 3; ++k)
            texel[k] = packed ? image.texels[3 * i + k] : (image.texels[3 * i + k] + 1) / 2;
        if (packed || texel != std::array{0.5, 0.5, 0.5}) seen.add(texel);  // zero vectors are no normals
    }
    return seen;
}

std::string doubt_of_normals(const TextureUse& use, const Image& image) {
    constexpr double far_off = 0.25, fits = 0.1, decoding_helps = 0.15;
    constexpr double flat = 0.735, nearly = 0.015;  // the middle, by sRGB's curve: 188 of 255
    const bool tangent = use.content == Content::normal;
    const Vectors seen = vectors_of(image, tangent);
    if (seen.off.empty()) return {};
    const double off = median(seen.off);
    const bool all_tilted =
        tangent && std::abs(median(seen.stored[0]) - flat) < nearly && std::abs(median(seen.stored[1]) - flat) < nearly;
    if (all_tilted || (off > decoding_helps && median(seen.off_if_decoded) < fits))
        return fmt::format(
            "{}: its normals look as if they were stored by sRGB's curve (flat is 188 of 255 then, instead of 128): "
            "save them without colour management (linear, raw, non-colour)",
            use.file.string());
    if (off > far_off)
        return fmt::format(
            "{}: half of its texels are off the unit length of a normal by {:.2f} or more; is it a normal map?",
            use.file.string(), off);
    if (tangent && 10 * seen.below > seen.off.size())
        return fmt::format(
            "{}: {:.0f}% of its normals point into the surface; is it in object space? then use kind = "
            "\"object_normal\"",
            use.file.string(), 100 * static_cast<double>(seen.below) / static_cast<double>(seen.off.size()));
    return {};
}

/// Whether the first rows of a file show colours. EXR files are told by the names of their layers.
bool is_in_colour(const std::filesystem::path& file) {
    constexpr float visible = 0.05f;
    const OpenImage opened(file);
    OIIO::ImageInput& input = opened.input();
    const auto spec = input.spec();
    if (std::string_view(input.format_name()) == "openexr" || spec.nchannels < 3 || spec.tile_width > 0) return false;
    const int rows = std::min(spec.height, kRows);
    std::vector<float> texels(3 * static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(rows));
    if (!input.read_scanlines(0, 0, spec.y, spec.y + rows, 0, 0, 3, OIIO::TypeFloat, texels.data())) {
        input.geterror();
        return false;
    }
    std::size_t coloured = 0;
    for (std::size_t i = 0; i < texels.size(); i += 3) {
        const auto [low, high] = std::minmax({texels[i], texels[i + 1], texels[i + 2]});
        coloured += high - low > visible;
    }
    return 10 * coloured > texels.size() / 3;
}

/// The tile that is missing between others, whose place is flat.
std::string doubt_of_tiles(const std::filesystem::path& pattern) {
    const std::vector<UdimTile> tiles = udim_tiles(pattern);
    const UdimSpan span = udim_span(tiles);
    for (int row = 0; row < span.rows; ++row)
        for (int column = 0; column < span.columns; ++column)
            if (std::ranges::none_of(tiles, [&](const UdimTile& t) { return t.column == column && t.row == row; }))
                return fmt::format("{}: there is no tile {} among its {}: its place is flat, at height 0",
                                   pattern.string(), 1001 + column + 10 * row, tiles.size());
    return {};
}

}  // namespace

std::string texture_doubt(const TextureUse& use, const Image& image) {
    if (is_udim(use.file))
        if (std::string doubt = doubt_of_tiles(use.file); !doubt.empty()) return doubt;
    if (use.content == Content::normal || use.content == Content::object_normal) return doubt_of_normals(use, image);
    if (use.content != Content::height) return {};
    if (!is_in_colour(is_udim(use.file) ? udim_tiles(use.file).front().file : use.file)) return {};
    return fmt::format("{}: a picture in colour, of which the first channel is taken as heights; is it a height map?",
                       use.file.string());
}

}  // namespace wrinkle::io
