// sources/noise_lookup.clh: every way to read the tables gives the hashes and directions of the 2002 paper.
#include <gtest/gtest.h>

#include "tests/kernels/kernel_function.h"
#include "tests/reference/noise.h"

namespace wrinkle::test {
namespace {

using reference::perlin_permutation;

TEST(NoiseLookup, GivesHashesAndDirectionsOnAnyLanes) {
    std::vector<float> numbers;
    for (int i = 0; i < 511; ++i) numbers.push_back(static_cast<float>(i));  // a hash and a cell, both up to 255
    for (const int lanes : {1, 4, 8, 16}) {
        const Results r = run_kernel(
            {"index low, high, hash = wr_perlin_lookup(wr_index(i)); wr_perlin_pair(wr_index(i), &low, &high);"
             "vec3 a = wr_perlin_corner(low), b = wr_perlin_corner(high);",
             {"wr_real(hash & 255)", "wr_real(hash >> 8)", "a.x", "a.y", "a.z", "b.x", "b.y", "b.z"}},
            {{"i", numbers}}, {lanes, false});
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const int here = perlin_permutation[i & 255], next = perlin_permutation[(i + 1) & 255];
            const auto a = reference::perlin_direction<double>(here), b = reference::perlin_direction<double>(next);
            const double want[] = {double(here), double(next), a.x, a.y, a.z, b.x, b.y, b.z};
            for (std::size_t k = 0; k < 8; ++k) EXPECT_EQ(r[k][i], want[k]) << lanes << " lanes, " << i << ", " << k;
        }
    }
}

}  // namespace
}  // namespace wrinkle::test
