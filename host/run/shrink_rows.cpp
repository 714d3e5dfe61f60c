#include "run/shrink_rows.h"

#include <cmath>

namespace wrinkle {

namespace {

/// Calls use(i, to) for every pixel i, with the number of the pixel that it becomes a part of.
template <class Use>
void each_pixel(std::size_t width, std::size_t rows, std::size_t scale, const Use& use) {
    for (std::size_t y = 0; y < rows; ++y)
        for (std::size_t x = 0; x < width; ++x) use(y * width + x, y / scale * (width / scale) + x / scale);
}

/// Normals that cancel each other have no direction: the mean stays 0.
void to_unit_length(std::span<std::vector<float>* const> axes) {
    for (std::size_t i = 0; i < axes[0]->size(); ++i) {
        double square = 0;
        for (const std::vector<float>* axis : axes) square += static_cast<double>((*axis)[i]) * (*axis)[i];
        if (!(square > 0)) continue;
        for (std::vector<float>* axis : axes) (*axis)[i] = static_cast<float>((*axis)[i] / std::sqrt(square));
    }
}

}  // namespace

std::vector<std::vector<float>> shrink_rows(std::span<const std::string> names, std::span<const float* const> planes,
                                            std::size_t width, std::size_t rows, std::size_t scale) {
    const std::size_t count = width / scale * (rows / scale);
    std::vector<std::vector<float>> out(planes.size());
    std::vector<std::vector<float>*> normal;
    for (std::size_t k = 0; k < planes.size(); ++k) {
        if (names[k] == "out:marked") {
            std::vector<unsigned> bits(count);
            each_pixel(width, rows, scale,
                       [&](std::size_t i, std::size_t to) { bits[to] |= static_cast<unsigned>(planes[k][i]); });
            out[k].assign(bits.begin(), bits.end());
            continue;
        }
        std::vector<double> sums(count);
        each_pixel(width, rows, scale, [&](std::size_t i, std::size_t to) { sums[to] += planes[k][i]; });
        for (const double sum : sums) out[k].push_back(static_cast<float>(sum / static_cast<double>(scale * scale)));
        if (names[k].starts_with("out:normal.")) normal.push_back(&out[k]);
    }
    if (normal.size() == 3) to_unit_length(normal);
    return out;
}

}  // namespace wrinkle
