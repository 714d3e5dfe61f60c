#include "resources/volume_levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "resources/volume_products.h"
#include "tests/reference/volume.h"

namespace wrinkle {
namespace {

/// Random voxels, constants and background beside one another, on both sides of 0.
Volume mixed(int channels) {
    Volume volume;
    volume.info.channels = channels;
    volume.first = {-2, -1, 1}, volume.count = {3, 2, 3};
    volume.constants = {0.5F, 0.25F, -1, 2, 3, 4};
    std::mt19937 random(8);
    std::int32_t leaves = 0;
    for (std::size_t i = 0; i < 3 * 2 * 3; ++i) volume.blocks.push_back(i % 3 == 0 ? leaves++ : i % 2 == 0 ? -2 : -1);
    for (std::size_t i = 0; i < static_cast<std::size_t>(leaves * channels) * Volume::block_voxels; ++i)
        volume.voxels.push_back(static_cast<float>(random()) / 4294967296.0F);
    return volume;
}

/// Voxels of level k around the grid's box and beyond it.
template <class Check>
void for_voxels(const Volume& volume, int k, int step, const Check& check) {
    const auto low = [&](std::size_t axis) { return ((8 * volume.first[axis]) >> k) - 2; };
    const auto high = [&](std::size_t axis) { return ((8 * (volume.first[axis] + volume.count[axis])) >> k) + 2; };
    for (int z = low(2); z <= high(2); z += step)
        for (int y = low(1); y <= high(1); y += step)
            for (int x = low(0); x <= high(0); x += step) check(x, y, z);
}

TEST(VolumeLevels, AreMeansOfTheVoxels) {
    for (const int channels : {1, 3}) {
        const Volume volume = mixed(channels);
        const std::vector<Volume> levels = coarser_levels(volume);
        ASSERT_EQ(levels.size(), 4u) << "24 voxels in x from -16 on, 16 in y from -8, 24 in z from 8: two of 16 each";
        for (int k = 1; k <= 4; ++k)
            for_voxels(volume, k, k < 3 ? 3 : 1, [&](int x, int y, int z) {
                for (int c = 0; c < channels; ++c) {
                    double sum = 0;
                    for (int i = 0; i < 1 << 3 * k; ++i) {
                        const int mask = (1 << k) - 1;
                        sum += static_cast<double>(
                            volume.at((x << k) + (i & mask), (y << k) + (i >> k & mask), (z << k) + (i >> 2 * k), c));
                    }
                    ASSERT_NEAR(levels[static_cast<std::size_t>(k - 1)].at(x, y, z, c), sum / (1 << 3 * k), 1e-6)
                        << k << ": " << x << " " << y << " " << z;
                }
            });
    }
}

/// The mean of the six products over a cube of whole cells, by interpolation as the papers have it and three points of
/// Gauss's quadrature along each axis of a cell, which is exact for them.
std::array<double, 6> integrated_products(const Volume& volume, VolumeFilter filter, const double (&from)[3],
                                          int edge) {
    const double nodes[] = {0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)}, weights[] = {5 / 18., 8 / 18., 5 / 18.};
    const int points = 3 * edge;
    std::array<double, 6> sums{};
    using V = reference::Vec<double>;
    const auto voxels = [&](int c) -> reference::Voxels<double> {
        return [&volume, c](int x, int y, int z) { return static_cast<double>(volume.at(x, y, z, c)); };
    };
    for (int i = 0; i < points * points * points; ++i) {
        const int at[] = {i % points, i / points % points, i / points / points};
        const auto place = [&](int axis) { return from[axis] + at[axis] / 3 + nodes[at[axis] % 3]; };
        const double weight =
            weights[at[0] % 3] * weights[at[1] % 3] * weights[at[2] % 3] / (double{1} * edge * edge * edge);
        const V p{place(0), place(1), place(2)};
        V g;
        if (volume.info.channels == 3)
            g = {reference::trilinear(voxels(0), p).value, reference::trilinear(voxels(1), p).value,
                 reference::trilinear(voxels(2), p).value};
        else
            g = filter == VolumeFilter::smooth ? reference::quadratic_spline(voxels(0), p).gradient
                                               : reference::trilinear(voxels(0), p).gradient;
        const double products[] = {g.x * g.x, g.x * g.y, g.x * g.z, g.y * g.y, g.y * g.z, g.z * g.z};
        for (std::size_t k = 0; k < 6; ++k) sums[k] += weight * products[k];
    }
    return sums;
}

void expect_products(const Volume& volume, VolumeFilter filter, double tolerance) {
    const std::vector<SlopeProducts> levels = product_levels(volume, filter, 2);
    ASSERT_EQ(levels.size(), 2u);
    const double cell = volume.info.channels == 1 && filter == VolumeFilter::smooth ? -0.5 : 0;
    for_voxels(volume, 2, 4, [&](int x, int y, int z) {
        const double from[] = {4 * x + cell, 4 * y + cell, 4 * z + cell};
        const std::array<double, 6> want = integrated_products(volume, filter, from, 4);
        for (int c = 0; c < 6; ++c) {
            const Volume& found = c < 3 ? levels[1].first : levels[1].second;
            ASSERT_NEAR(found.at(x, y, z, c % 3), want[static_cast<std::size_t>(c)],
                        tolerance * (1e-2 + want[0] + want[3] + want[5]))
                << c << ": " << x << " " << y << " " << z;
        }
    });
}

TEST(VolumeLevels, HoldTheProductsOfTrilinearSlopes) { expect_products(mixed(1), VolumeFilter::linear, 2e-5); }
TEST(VolumeLevels, HoldTheProductsOfSmoothSlopes) { expect_products(mixed(1), VolumeFilter::smooth, 2e-2); }
TEST(VolumeLevels, HoldTheProductsOfVectors) { expect_products(mixed(3), VolumeFilter::linear, 2e-5); }

TEST(VolumeLevels, OfNothingAreNone) {
    Volume empty;
    EXPECT_TRUE(coarser_levels(empty).empty());
    EXPECT_TRUE(product_levels(empty, VolumeFilter::linear, 0).empty());
}

}  // namespace
}  // namespace wrinkle
