#pragma once

#include "tests/reference/noise.h"

namespace wrinkle::reference {

/// psrdnoise in three dimensions [Gustavson and McEwan 2021]. The lattice consists of the points (x, y, z) whose sums y
/// + z, x + z and x + y are whole numbers. Only the four corners of the simplex around a point are within sqrt(1/2) of
/// it. So all lattice points around are summed here, and the weight max(1/2 - r^2, 0)^3 leaves only the corners.
///   period   0, or the number of cells after which an axis repeats
///   flow     angle in radians by which the gradients are turned
template <class T>
NoiseValue<T> simplex_noise(Vec<T> p, Vec<T> period, T flow) {
    const auto modulo = [](T v, T m) { return v - m * std::floor(v / m); };
    const auto permute = [&](T i) {
        const T j = modulo(i, 289);
        return modulo((34 * j + 10) * j, 289);
    };
    NoiseValue<T> n;
    const T cx = std::floor(p.x), cy = std::floor(p.y), cz = std::floor(p.z);
    for (int i = -2; i <= 4; ++i)
        for (int j = -2; j <= 4; ++j)
            for (int k = -2; k <= 4; ++k) {
                if ((i + j) % 2 != 0 || (i + k) % 2 != 0) continue;  // coordinates are all whole or all halves
                const Vec<T> corner{cx + T(i) / 2, cy + T(j) / 2, cz + T(k) / 2}, d = p - corner;
                const T reach = T(1) / 2 - dot(d, d);
                if (reach <= 0) continue;
                const T x = period.x > 0 ? modulo(corner.x, period.x) : corner.x;
                const T y = period.y > 0 ? modulo(corner.y, period.y) : corner.y;
                const T z = period.z > 0 ? modulo(corner.z, period.z) : corner.z;
                const T hash = permute(permute(permute(x + y) + x + z) + y + z);
                const T theta = hash * T(3.883222077L), height = T(0.996539792L) - hash * T(0.006920415L);
                const T psi = hash * T(0.108705628L), radius = std::sqrt(1 - height * height);
                const Vec<T> g{std::cos(theta) * radius, std::sin(theta) * radius, height};
                // Perpendicular to g, and with it in the plane of rotation; as published.
                const T c = std::sin(theta) * std::sin(psi) - std::cos(theta) * std::cos(psi);
                const Vec<T> q{c * std::sin(theta) * (1 - height) + std::sin(psi) * height,
                               std::cos(psi) * height - c * std::cos(theta) * (1 - height),
                               -(g.y * std::cos(psi) + g.x * std::sin(psi))};
                const Vec<T> turned = g * std::cos(flow) + q * std::sin(flow);
                const T ramp = dot(turned, d);
                n.value += T(39.5L) * reach * reach * reach * ramp;
                n.gradient =
                    n.gradient + (turned * (reach * reach * reach) - d * (6 * reach * reach * ramp)) * T(39.5L);
            }
    return n;
}

}  // namespace wrinkle::reference
