#include "resources/octahedral_map.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"

namespace wrinkle {

namespace {

/// The fold of the lower half, which is its own inverse.
std::array<double, 2> folded(double x, double y) {
    return {std::copysign(1 - std::abs(y), x), std::copysign(1 - std::abs(x), y)};
}

}  // namespace

const OctahedralMap::Texel& OctahedralMap::at(int x, int y) const {
    if (x < 0 || x >= size) x = std::clamp(x, 0, size - 1), y = size - 1 - y;
    if (y < 0 || y >= size) y = std::clamp(y, 0, size - 1), x = size - 1 - x;
    return all[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
}

OctahedralMap::Texel OctahedralMap::sample(const Vec3& direction) const {
    const auto [s, t] = place(direction);
    const double x = s * size - 0.5, y = t * size - 0.5, left = std::floor(x), low = std::floor(y);
    const int i = static_cast<int>(left), j = static_cast<int>(low);
    const auto right = static_cast<float>(x - left), up = static_cast<float>(y - low);
    const Texel &a = at(i, j), &b = at(i + 1, j), &c = at(i, j + 1), &d = at(i + 1, j + 1);
    Texel out{};
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = (a[k] * (1 - right) + b[k] * right) * (1 - up) + (c[k] * (1 - right) + d[k] * right) * up;
    return out;
}

OctahedralMap OctahedralMap::half() const {
    OctahedralMap coarse(size / 2);
    for (int y = 0; y < coarse.size; ++y)
        for (int x = 0; x < coarse.size; ++x)
            for (std::size_t k = 0; k < 3; ++k)
                coarse.all[static_cast<std::size_t>(y * coarse.size + x)][k] =
                    at(2 * x, 2 * y)[k] / 4 + at(2 * x + 1, 2 * y)[k] / 4 + at(2 * x, 2 * y + 1)[k] / 4 +
                    at(2 * x + 1, 2 * y + 1)[k] / 4;
    return coarse;
}

Vec3 OctahedralMap::direction(double s, double t) {
    double x = 2 * s - 1, y = 2 * t - 1;
    const double z = 1 - std::abs(x) - std::abs(y);
    if (z < 0) {
        const auto inner = folded(x, y);
        x = inner[0], y = inner[1];
    }
    return normalize({x, y, z});
}

std::array<double, 2> OctahedralMap::place(const Vec3& d) {
    const double over = 1 / (std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]));
    std::array<double, 2> at{d[0] * over, d[1] * over};
    if (d[2] < 0) at = folded(at[0], at[1]);
    return {at[0] / 2 + 0.5, at[1] / 2 + 0.5};
}

}  // namespace wrinkle
