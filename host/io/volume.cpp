#include "io/volume.h"

#include <cmath>

namespace wrinkle {

bool is_singular(const Mat4& m) {
    const auto axis = [&](std::size_t k) { return std::hypot(m[0][k], m[1][k], m[2][k]); };
    const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    constexpr double kFlat = 1e-9;  // share of the volume that the axes would span if they were perpendicular
    return !(std::abs(determinant) > kFlat * axis(0) * axis(1) * axis(2)) || !std::isfinite(determinant);
}

std::optional<std::size_t> Volume::block(int x, int y, int z) const {
    const int local[3] = {x - first[0], y - first[1], z - first[2]};
    std::size_t place = 0;
    for (int axis = 2; axis >= 0; --axis) {
        const auto size = count[static_cast<std::size_t>(axis)];
        if (local[axis] < 0 || local[axis] >= size) return std::nullopt;
        place = place * static_cast<std::size_t>(size) + static_cast<std::size_t>(local[axis]);
    }
    return place;
}

float Volume::at(int x, int y, int z, int channel) const {
    const auto place = block(x >> 3, y >> 3, z >> 3);
    const std::int32_t number = place ? blocks[*place] : -1;
    if (number < 0) return constants[static_cast<std::size_t>(3 * (-1 - number) + channel)];
    return voxels[static_cast<std::size_t>(number * info.channels + channel) * block_voxels +
                  static_cast<std::size_t>(((z & 7) * edge + (y & 7)) * edge + (x & 7))];
}

}  // namespace wrinkle
