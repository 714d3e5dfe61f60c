#pragma once

#include "io/texture_file.h"

namespace wrinkle {

/// Adds the squares of two slopes and their product, as five channels: s, t, ss, st, tt. Their means over an area, less
/// the products of the mean slopes, are the covariance of the slopes there.
Image with_products(const Image& slopes);

/// What bilinear samples of a level's slopes do not show: the covariance, ss, st, tt, of the finest slopes around the
/// sample that they give, as its mean over all samples that lie in a texel.
///   level   means of the slopes and of their products over each texel, as with_products() arranges them
/// Exact but for rounding; never a negative variance, nor a correlation above 1.
Image lost_slopes(const Image& level, Wrap wrap);

}  // namespace wrinkle
