#pragma once

#include <array>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <tuple>

#include "tests/reference/height_slope.h"
#include "tests/reference/tangent_normal.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

using Images = std::map<std::string, Image>;  ///< key: the texture's file as the scene names it

template <class T>
struct TexCoord {
    Vec2<T> st;
    TexDerivative<T> d;
};

/// A texture of a layer, ready to give slopes.
template <class T>
struct LayerTexture {
    std::shared_ptr<const Pyramid<T>> pyramid;  ///< heights, or the two slopes of tangent-space normals
    Content content = Content::height;
    std::shared_ptr<const Pyramid<T>> slopes;  ///< of heights, for Upscale::smooth
    Upscale upscale = Upscale::smooth;
    Address wrap = Address::repeat;

    T lod(const TexDerivative<T>& d, bool footprint) const {
        const Level<T>& top = pyramid->levels.front();
        const int levels = static_cast<int>(pyramid->levels.size());
        return footprint ? level_of_detail(d, top.width, top.height, levels, filter_finer<T>()) : T(0);
    }
    /// The vector of an object-space normal map.
    Vec<T> vector(const TexCoord<T>& at, bool footprint) const {
        const T level = lod(at.d, footprint);
        const auto part = [&](int k) { return sample(*pyramid, k, at.st, level, wrap); };
        return {part(0), part(1), part(2)};
    }
    /// For height and slope maps, dh per unit s and t. For normal maps, the slope, which has no unit.
    Vec2<T> slope(const TexCoord<T>& at, bool footprint) const {
        const T level = lod(at.d, footprint);
        if (content != Content::height)
            return {sample(*pyramid, 0, at.st, level, wrap), sample(*pyramid, 1, at.st, level, wrap)};
        if (upscale == Upscale::smooth)
            return {sample(*slopes, 0, at.st, level, wrap), sample(*slopes, 1, at.st, level, wrap)};
        return plain_slope(*pyramid, at.st, level, wrap);
    }
};

/// The slopes [Mik20 listing 2] of the texels of a tangent-space normal map, which are brought from [0,1] to [-1,1]
/// first. Mips are means of slopes.
template <class T>
Pyramid<T> slope_pyramid(const Image& image, bool y_down) {
    const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
    Level<T> top{image.width, image.height, std::vector<T>(2 * count)};
    if (image.channels < 2) throw std::runtime_error("reference: a normal map needs at least two channels");
    for (std::size_t i = 0; i < count; ++i) {
        const float* c = image.texels.data() + i * image.channels;
        const Vec<T> m{2 * T(c[0]) - 1, 2 * T(c[1]) - 1, image.channels > 2 ? 2 * T(c[2]) - 1 : T(0)};
        const Vec2<T> d = image.channels > 2 ? slope_from_tangent_normal(m, y_down)
                                             : slope_from_two_components<T>({m.x, y_down ? -m.y : m.y}, T(1e-6L));
        top.texels[i] = d.x;
        top.texels[count + i] = d.y;
    }
    return build_pyramid(std::move(top), 2);
}

/// All channels as they are, with the second one negated if `y_down`.
template <class T>
Pyramid<T> value_pyramid(const Image& image, bool y_down) {
    Level<T> top{image.width, image.height, {}};
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t i = c; i < image.texels.size(); i += channels)
            top.texels.push_back(y_down && c == 1 ? -T(image.texels[i]) : T(image.texels[i]));
    return build_pyramid(std::move(top), image.channels);
}

using Region = std::array<double, 4>;  ///< s and t from, s and t to
inline constexpr Region whole{0, 0, 1, 1};

/// The texels of a region, whose edges are moved to the nearest edges of texels.
inline Image cut(const Image& image, const Region& region) {
    const auto edge = [](double at, int size) { return static_cast<int>(std::floor(at * size + 0.5)); };
    const int left = std::min(edge(region[0], image.width), image.width - 1);
    const int bottom = std::min(edge(region[1], image.height), image.height - 1);
    const int right = std::max(edge(region[2], image.width), left + 1);
    const int top = std::max(edge(region[3], image.height), bottom + 1);
    Image out{right - left, top - bottom, image.channels, {}};
    for (int y = bottom; y < top; ++y) {
        const auto row = image.texels.begin() + static_cast<std::ptrdiff_t>(y) * image.width * image.channels;
        out.texels.insert(out.texels.end(), row + left * image.channels, row + right * image.channels);
    }
    return out;
}

/// The textures of a scene. Builds each pyramid once.
template <class T>
class SceneTextures {
public:
    explicit SceneTextures(const Images& images) : images_(images) {}

    LayerTexture<T> slopes(const TextureUse& use, Content content, const Region& region = whole) {
        const bool y_down = (content == Content::normal || content == Content::slope) && use.y_down;
        const Address wrap = use.wrap == Wrap::repeat ? Address::repeat : Address::clamp;
        const auto values = pyramid(use.file.string(), content, y_down, region);
        return {values, content, content == Content::height ? smooth(values, wrap) : nullptr, use.upscale, wrap};
    }
    /// The first channel of a file as a texture that repeats, for masks.
    LayerTexture<T> values(const std::string& file) {
        return {pyramid(file, Content::height, false, whole), Content::height, nullptr, Upscale::plain,
                Address::repeat};
    }

private:
    std::shared_ptr<const Pyramid<T>> pyramid(const std::string& file, Content content, bool y_down,
                                              const Region& region) {
        auto& slot = pyramids_[{file, content, y_down, region}];
        if (slot) return slot;
        const auto image = images_.find(file);
        if (image == images_.end()) throw std::runtime_error("reference: texture not given: " + file);
        const Image part = cut(image->second, region);
        slot = std::make_shared<const Pyramid<T>>(content == Content::normal   ? slope_pyramid<T>(part, y_down)
                                                  : content == Content::height ? first_channel_pyramid<T>(part)
                                                                               : value_pyramid<T>(part, y_down));
        return slot;
    }

    std::shared_ptr<const Pyramid<T>> smooth(const std::shared_ptr<const Pyramid<T>>& heights, Address wrap) {
        auto& slot = slopes_[{heights.get(), wrap}];
        if (!slot) slot = std::make_shared<const Pyramid<T>>(smooth_slopes(heights->levels.front(), wrap));
        return slot;
    }

    const Images& images_;
    std::map<std::pair<const Pyramid<T>*, Address>, std::shared_ptr<const Pyramid<T>>> slopes_;
    std::map<std::tuple<std::string, Content, bool, Region>, std::shared_ptr<const Pyramid<T>>> pyramids_;
};

}  // namespace wrinkle::reference
