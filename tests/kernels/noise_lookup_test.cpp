// sources/noise_lookup.clh: every way to read the tables gives the hashes and directions of the 2002 paper.
#include <gtest/gtest.h>

#include "tests/kernels/kernel_function.h"
#include "tests/reference/noise.h"

namespace wrinkle::test {
namespace {

using reference::perlin_permutation;

TEST(NoiseLookup, GivesHashesAndDirectionsOnAnyLanes) {
    std::vector<float> numbers;
    // Only the low 8 bits count, also of negative numbers.
    for (int i = -300; i < 511; ++i) numbers.push_back(static_cast<float>(i));
    for (const auto& [lanes, fp64] :
         {std::pair{1, false}, {4, false}, {8, false}, {16, false}, {1, true}, {8, true}, {16, true}}) {
        if (lanes_to_try({lanes}).empty() || (fp64 && !test_device().info.fp64)) continue;
        const Results r = run_kernel(
            {"wr_index hash = wr_perlin_lookup(wr_to_index(i)); wr_vec3 a, b; wr_perlin_corners(wr_to_index(i), &a, "
             "&b);",
             {"wr_to_real(hash & 255)", "wr_to_real(hash >> 8 & 255)", "a.x", "a.y", "a.z", "b.x", "b.y", "b.z"}},
            {{"i", numbers}}, {lanes, fp64});
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto number = static_cast<std::size_t>(static_cast<int>(numbers[i]) & 255);
            const int here = perlin_permutation[number], next = perlin_permutation[(number + 1) & 255];
            const auto a = reference::perlin_direction<double>(here), b = reference::perlin_direction<double>(next);
            const double want[] = {double(here), double(next), a.x, a.y, a.z, b.x, b.y, b.z};
            for (std::size_t k = 0; k < 8; ++k)
                EXPECT_EQ(r[k][i], want[k])
                    << lanes << (fp64 ? " lanes in double, " : " lanes, ") << numbers[i] << ", " << k;
        }
    }
}

}  // namespace
}  // namespace wrinkle::test
