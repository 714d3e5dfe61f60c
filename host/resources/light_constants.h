#pragma once

#include "wrinkle/lighting.h"

#include "layout.h"

namespace wrinkle {

/// A light that is no sky, as kernels read it, without the numbers of its pictures.
wr_light fill_light(const Light& light, const Vec3& eye);

/// Adds the irradiance / pi of a sky, as coefficients of the polynomials of wr_sky.
void add_sky(double (&sky)[27], const Light& light);

}  // namespace wrinkle
