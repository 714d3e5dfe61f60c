#include "io/packed_normals.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/median.h"

namespace wrinkle::io {
namespace {}  // namespace

bool cannot_be_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    constexpr float rounding = 0.01f;  // allows for half floats and 8-bit sources
    const auto outside = [](float c) { return c < -rounding || c > 1 + rounding; };
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::isfinite(x[i] + y[i] + z[i]) && (outside(x[i]) || outside(y[i]) || outside(z[i]))) return true;
    return false;
}

bool looks_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    if (cannot_be_packed(x, y, z)) return false;
    constexpr float unit_length = 0.03f;  // allows for filtering, which shortens normals a little
    std::vector<float> raw, unpacked;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const float n[3] = {x[i], y[i], z[i]};
        if (n[0] == 0 && n[1] == 0 && n[2] == 0) continue;
        if (!std::isfinite(n[0] + n[1] + n[2])) continue;
        raw.push_back(std::abs(std::hypot(n[0], n[1], n[2]) - 1));
        unpacked.push_back(std::abs(std::hypot(2 * n[0] - 1, 2 * n[1] - 1, 2 * n[2] - 1) - 1));
    }
    return !raw.empty() && median(unpacked) < unit_length && median(raw) > unit_length;
}

void turn_normals(const Mat4& view, std::span<float> x, std::span<float> y, std::span<float> z) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double n[3] = {x[i], y[i], z[i]};
        const auto world = [&](std::size_t k) {  // the view is rigid: its inverse is its transpose
            return static_cast<float>(view[0][k] * n[0] + view[1][k] * n[1] + view[2][k] * n[2]);
        };
        x[i] = world(0), y[i] = world(1), z[i] = world(2);
    }
}

void unpack_normals(std::span<float> x, std::span<float> y, std::span<float> z) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (x[i] == 0 && y[i] == 0 && z[i] == 0) continue;
        x[i] = 2 * x[i] - 1, y[i] = 2 * y[i] - 1, z[i] = 2 * z[i] - 1;
    }
}

}  // namespace wrinkle::io
