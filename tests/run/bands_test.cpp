// How frames are cut into bands.
#include "run/bands.h"

#include <gtest/gtest.h>

namespace wrinkle::test {
namespace {

constexpr std::uint64_t kGiB = std::uint64_t{1} << 30;
constexpr std::size_t k8K = std::size_t{7680} * 4320;

DeviceInfo of_units(unsigned units, bool own_memory) {
    DeviceInfo info;
    info.compute_units = units;
    info.memory = 64 * kGiB, info.largest_buffer = 16 * kGiB;
    info.own_memory = own_memory;
    return info;
}

TEST(Bands, AreAsLargeAsADeviceWithItsOwnMemoryWants) {
    EXPECT_EQ(band_pixels(of_units(132, true), k8K, 40, 4, 5), 132u << 14);
    EXPECT_EQ(band_pixels(of_units(1000, true), 8 * k8K, 40, 4, 5), 1u << 22);
    EXPECT_EQ(band_pixels(of_units(132, true), 1u << 23, 40, 4, 5), 1u << 20) << "eight of them overlap";
    EXPECT_EQ(band_pixels(of_units(2, true), k8K, 40, 4, 5), 1u << 18);
    EXPECT_EQ(band_pixels(of_units(132, true), 1000, 40, 4, 5), 1u << 18);
}

TEST(Bands, AreAsLargeAsCoresWant) {
    EXPECT_EQ(band_pixels(of_units(1, false), k8K, 40, 4, 5), 1u << 17);
    EXPECT_EQ(band_pixels(of_units(8, false), k8K, 40, 4, 5), 1u << 19);
    EXPECT_EQ(band_pixels(of_units(64, false), 1000, 40, 4, 5), 1u << 20);
    EXPECT_EQ(band_pixels(of_units(1, false), 1000, 40, 4, 1), 1u << 20) << "that do not overlap";
}

TEST(Bands, FitIntoTheDevice) {
    for (const bool own : {false, true}) {
        DeviceInfo info = of_units(16, own);
        info.memory = kGiB / 4;
        EXPECT_EQ(band_pixels(info, k8K, 64, 4, 5), kGiB / 4 / (16 * 5 * 64)) << "a sixteenth of it, for five";
        EXPECT_EQ(band_pixels(info, k8K, 64, 4, 3), kGiB / 4 / (16 * 3 * 64));
        info = of_units(16, own);
        info.largest_buffer = 1 << 20;
        EXPECT_EQ(band_pixels(info, k8K, 64, 16, 5), 1u << 16);
        info.largest_buffer = 1;
        EXPECT_EQ(band_pixels(info, k8K, 64, 16, 5), 1u);
    }
}

TEST(Bands, CoverTheFrame) {
    const BandGrid grid{.size = {5, 10}, .rows = 4, .halo = 1};
    ASSERT_EQ(grid.count(), 3u);
    EXPECT_EQ(grid.pixels(), 20u);
    EXPECT_EQ(grid.read_pixels(), 30u);
    const auto expect = [&](std::uint32_t band, const Rows& want) {
        const Rows rows = grid.rows_of(band);
        EXPECT_EQ(rows.first, want.first);
        EXPECT_EQ(rows.count, want.count);
        EXPECT_EQ(rows.before, want.before);
        EXPECT_EQ(rows.after, want.after);
    };
    expect(0, {.first = 0, .count = 4, .before = 0, .after = 1});
    expect(1, {.first = 4, .count = 4, .before = 1, .after = 1});
    expect(2, {.first = 8, .count = 2, .before = 1, .after = 0});
}

}  // namespace
}  // namespace wrinkle::test
