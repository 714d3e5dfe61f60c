#pragma once

#include <vector>

#include "wrinkle/camera.h"

namespace wrinkle {

/// A direction of the lobe that a surface mirrors when it is seen along its normal, which is z.
struct LobeSample {
    Vec3 direction;
    double weight;       ///< its share of what is mirrored; all together are 1
    double solid_angle;  ///< for which it stands
};

/// `count` of them: quantiles of GGX's normals [Walter et al. 2007], weighted by height-correlated shadowing [Heitz
/// 2014].
std::vector<LobeSample> lobe_along_normal(double alpha, std::size_t count);

/// What the lobe of any view is like, as wr_sky_lobe_of reads it: 2 WR_LOBE_SIZE x WR_LOBE_SIZE texels of three
/// numbers, bottom row first. From the left on for the part of the reflectance that Fresnel's term leaves as at normal
/// incidence (1 - (1 - v.h)^5), then for the other part. Columns: the root of the cosine between normal and view, from
/// 0 to 1; rows: the roughness. The numbers: how much is mirrored of light that comes alike from everywhere; and, over
/// alpha and times that, the moments of the mean direction: how much is missing to 1 along the mirrored ray r, and how
/// much of n - r (n.r) it has.
const std::vector<float>& ggx_lobes();

}  // namespace wrinkle
