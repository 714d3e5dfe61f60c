// sources/noise_table.clh: the packed tables hold the permutation and the gradients of the 2002 paper.
#include <gtest/gtest.h>

#include "tests/kernels/kernel_function.h"
#include "tests/reference/noise.h"

namespace wrinkle::test {
namespace {

using reference::perlin_permutation;

std::vector<float> count(int n) {
    std::vector<float> v;
    for (int i = 0; i < n; ++i) v.push_back(static_cast<float>(i));
    return v;
}

TEST(NoiseTable, HashHoldsNeighboursOfThePermutation) {
    const Results r =
        run_kernel({"ushort entry = wr_perlin_hash[(int)i];", {"(wr_real)(entry & 255)", "(wr_real)(entry >> 8)"}},
                   {{"i", count(256)}}, {1, false});
    for (std::size_t i = 0; i < 256; ++i) {
        EXPECT_EQ(r[0][i], perlin_permutation[i & 255]) << i;
        EXPECT_EQ(r[1][i], perlin_permutation[(i + 1) & 255]) << i;
    }
}

TEST(NoiseTable, ChoicesHoldTheLowBitsOfNeighbours) {
    const Results r = run_kernel({"ushort entry = wr_perlin_choice[(int)i];",
                                  {"(wr_real)(entry & 15)", "(wr_real)(entry >> 4 & 15)", "(wr_real)(entry >> 8 & 15)",
                                   "(wr_real)(entry >> 12)"}},
                                 {{"i", count(128)}}, {1, false});
    for (std::size_t i = 0; i < 128; ++i)
        for (std::size_t k = 0; k < 4; ++k)
            EXPECT_EQ(r[k][i], perlin_permutation[(i + 128 * (k / 2) + k % 2) & 255] & 15) << i << ", " << k;
}

TEST(NoiseTable, GradientsAreTheDirectionsOfTheHash) {
    const Results r = run_kernel(
        {"wr_vec3 g = wr_perlin_corner((wr_index)((int)wr_perlin_gradient[(int)i]));", {"g.x", "g.y", "g.z"}},
        {{"i", count(257)}}, {1, false});
    for (std::size_t i = 0; i < 257; ++i) {
        const auto want = reference::perlin_direction<double>(perlin_permutation[i & 255]);
        EXPECT_EQ(r[0][i], want.x) << i;
        EXPECT_EQ(r[1][i], want.y) << i;
        EXPECT_EQ(r[2][i], want.z) << i;
    }
}

}  // namespace
}  // namespace wrinkle::test
