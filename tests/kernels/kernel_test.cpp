// sources/kernel.clh
#include "tests/cases/cases.h"
#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(RandomOfCell, IsUniformAndOfAnotherSaltAnotherNumber) {
    Cases c{.name = "cells"};
    for (int i = 0; i < 4000; ++i) {
        c.add(fmt::format("cell {}", i), true);
        c.in("p", V{real(i % 63 - 31), real(i / 63 - 31), real(i % 7)});
    }
    ColumnKernel kernel{"", {"wr_random_of_cell(p, 1)", "wr_random_of_cell(p, 2)"}};
    const Results got = run_kernel(kernel, c.inputs, {8, false});
    for (const bool fp64 : precisions_to_try()) EXPECT_EQ(got, run_kernel(kernel, c.inputs, {1, fp64}));
    double mean = 0, square = 0, product = 0;
    for (std::size_t i = 0; i < c.size(); ++i) {
        ASSERT_TRUE(got[0][i] >= 0 && got[0][i] < 1);
        mean += got[0][i] / 4000, square += got[0][i] * got[0][i] / 4000;
        product += (got[0][i] - 0.5) * (got[1][i] - 0.5) / 4000;
    }
    EXPECT_NEAR(mean, 0.5, 0.02);
    EXPECT_NEAR(square, 1.0 / 3, 0.02);
    EXPECT_NEAR(product, 0, 0.01);
}

}  // namespace
}  // namespace wrinkle::test
