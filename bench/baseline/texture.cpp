#include "texture.h"

#include "surface_gradient.h"
#include "wrinkle/error.h"

namespace wrinkle::baseline {
namespace {

int wrapped(int i, int size, Wrap wrap) {
    return wrap == Wrap::clamp ? std::clamp(i, 0, size - 1) : ((i % size) + size) % size;
}

template <class T>
const T& at(const Grid<T>& grid, int x, int y, Wrap wrap) {
    return grid.at(wrapped(x, grid.width, wrap), wrapped(y, grid.height, wrap));
}

/// The next mip: means of 2x2 texels. Of odd sizes the last column or row is dropped; a side of 1 stays 1.
template <class T>
Grid<T> halved(const Grid<T>& in) {
    Grid<T> out{std::max(1, in.width / 2), std::max(1, in.height / 2), {}};
    out.texels.reserve(static_cast<std::size_t>(out.width) * out.height);
    for (int y = 0; y < out.height; ++y) {
        const int y0 = std::min(2 * y, in.height - 1), y1 = std::min(2 * y + 1, in.height - 1);
        for (int x = 0; x < out.width; ++x) {
            const int x0 = std::min(2 * x, in.width - 1), x1 = std::min(2 * x + 1, in.width - 1);
            out.texels.push_back(0.25F * ((in.at(x0, y0) + in.at(x1, y0)) + (in.at(x0, y1) + in.at(x1, y1))));
        }
    }
    return out;
}

/// All levels, finest first.
template <class T>
std::vector<Grid<T>> mip_chain(Grid<T> level0) {
    std::vector<Grid<T>> chain{std::move(level0)};
    while (chain.back().width > 1 || chain.back().height > 1) chain.push_back(halved(chain.back()));
    return chain;
}

Grid<float> first_channel(const Image& image) {
    Grid<float> out{image.width, image.height, {}};
    const std::size_t count = static_cast<std::size_t>(image.width) * image.height;
    if (image.width < 1 || image.height < 1 || image.channels < 1 || image.texels.size() < count * image.channels)
        throw Error("baseline: a texture is empty or has fewer texels than its size says");
    out.texels.reserve(count);
    for (std::size_t i = 0; i < count; ++i) out.texels.push_back(image.texels[i * image.channels]);
    return out;
}

Grid<float2> sobel_slopes(const Grid<float>& h, Wrap wrap) {
    Grid<float2> out{h.width, h.height, {}};
    out.texels.reserve(h.texels.size());
    const float to_s = 0.125F * static_cast<float>(h.width), to_t = 0.125F * static_cast<float>(h.height);
    for (int y = 0; y < h.height; ++y) {
        for (int x = 0; x < h.width; ++x) {
            const auto tap = [&](int i, int j) { return at(h, x + i, y + j, wrap); };
            const float ds = (tap(1, -1) - tap(-1, -1)) + 2 * (tap(1, 0) - tap(-1, 0)) + (tap(1, 1) - tap(-1, 1));
            const float dt = (tap(-1, 1) - tap(-1, -1)) + 2 * (tap(0, 1) - tap(0, -1)) + (tap(1, 1) - tap(1, -1));
            out.texels.push_back({to_s * ds, to_t * dt});
        }
    }
    return out;
}

}  // namespace

template <class T>
Pyramid<T>::Pyramid(const std::vector<Grid<T>>& levels, Wrap wrap)
    : width_(levels.front().width),
      height_(levels.front().height),
      wrap_(wrap),
      last_(static_cast<unsigned>(levels.size() - 1)) {
    for (const Grid<T>& grid : levels) {
        levels_.push_back({static_cast<unsigned>(grid.width), static_cast<unsigned>(grid.height),
                           static_cast<unsigned>(grid.width + 2), static_cast<float>(grid.width),
                           static_cast<float>(grid.height), texels_.size()});
        for (int y = -1; y <= grid.height; ++y)
            for (int x = -1; x <= grid.width; ++x) texels_.push_back(at(grid, x, y, wrap));
    }
    levels_.push_back(levels_.back());
}

Pyramid<float> scalar_pyramid(const Image& image, Wrap wrap) { return {mip_chain(first_channel(image)), wrap}; }

Pyramid<float2> height_slope_pyramid(const Image& image, Wrap wrap) {
    return {mip_chain(sobel_slopes(first_channel(image), wrap)), wrap};
}

Pyramid<float2> normal_slope_pyramid(const Image& image, Wrap wrap, bool y_down) {
    if (image.channels < 3) throw Error("baseline: a normal map needs 3 channels");
    Grid<float2> slopes{image.width, image.height, {}};
    const std::size_t count = first_channel(image).texels.size();
    for (std::size_t i = 0; i < count; ++i) {
        const float* c = image.texels.data() + i * image.channels;
        const float3 m{2 * c[0] - 1, 2 * c[1] - 1, 2 * c[2] - 1};
        slopes.texels.push_back(tspace_normal_to_derivative(m, y_down));
    }
    return {mip_chain(std::move(slopes)), wrap};
}

}  // namespace wrinkle::baseline
