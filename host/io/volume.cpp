#include "io/volume.h"

#include <cmath>

#include "base/imath.h"

namespace wrinkle {

bool is_singular(const Mat4& m) {
    const auto axis = [&](std::size_t k) { return Imath::V3d(m[0][k], m[1][k], m[2][k]); };
    const double determinant = axis(0).dot(axis(1).cross(axis(2)));
    constexpr double kFlat = 1e-9;  // share of the volume that the axes would span if they were perpendicular
    return !(std::abs(determinant) > kFlat * axis(0).length() * axis(1).length() * axis(2).length()) ||
           !std::isfinite(determinant);
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
