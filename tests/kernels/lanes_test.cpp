// lanes.clh
#include <gtest/gtest.h>

#include "tests/kernels/kernel_function.h"

namespace wrinkle::test {
namespace {

std::vector<float> count(std::size_t n) {
    std::vector<float> v;
    for (std::size_t i = 0; i < n; ++i) v.push_back(static_cast<float>(i));
    return v;
}

TEST(Lanes, LoadAndStoreKeepTheOrder) {
    const Columns columns{{"v", count(100)}};
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r = run_kernel({"", {"v", "wr_lane_number()"}}, columns, {lanes, fp64});
            for (std::size_t i = 0; i < 100; ++i) {
                EXPECT_EQ(r[0][i], static_cast<double>(i));
                EXPECT_EQ(r[1][i], static_cast<double>(i % static_cast<std::size_t>(lanes)));
            }
        }
}

/// Neighbours of the first and the last pixels that lie outside of the plane read as 0, and only those do.
TEST(Lanes, LoadNearStaysInside) {
    const std::size_t pixels = 37;
    std::vector<float> v = count(pixels);
    for (float& a : v) ++a;
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try())
            for (const int step : {-40, -17, -1, 0, 1, 5, 40}) {
                ColumnData data = float_planes({v});
                data.constants = {static_cast<double>(step), static_cast<double>(pixels)};
                const Results r = run_kernel(
                    {"wr_floats r = wr_load_near(texels, (long)at + (long)constants[0], (long)constants[1]);",
                     {"wr_to_real(r)"}},
                    {{"v", v}}, {lanes, fp64}, data);
                for (std::size_t i = 0; i < pixels; ++i) {
                    const long j = static_cast<long>(i) + step;
                    EXPECT_EQ(r[0][i], j >= 0 && j < long{pixels} ? j + 1.0 : 0.0)
                        << i << " + " << step << ", " << lanes;
                }
            }
}

TEST(Lanes, FloorOfAnyNumber) {
    const std::vector<float> v{0, -0.0f, 0.5f, -0.5f, 1, -1, -1e-45f, 1e-45f, 8388607.5f, -8388607.5f, 3e38f, -3e38f};
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r = run_kernel({"", {"wr_floor(v)"}}, {{"v", v}}, {lanes, fp64});
            for (std::size_t i = 0; i < v.size(); ++i) EXPECT_EQ(r[0][i], std::floor(double{v[i]})) << v[i];
        }
}

TEST(Lanes, Log2) {
    std::vector<float> v{1, 2, 4, 1.4142135f, 1.4142137f, 1e30f};
    for (int i = 0; i < 500; ++i) v.push_back(static_cast<float>(std::exp2(i * 0.2)));
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r = run_kernel({"", {"wr_log2(v)"}}, {{"v", v}}, {lanes, fp64});
            for (std::size_t i = 0; i < v.size(); ++i) {
                const double want = std::log2(double{v[i]});  // large results are compared by their own ulp
                EXPECT_NEAR(r[0][i], want, fp64 ? 1e-13 : 2e-7 + want * 6e-8) << v[i];
            }
        }
}

TEST(Lanes, AnyIsTrueWhereOneLaneIs) {
    std::vector<float> v(64);
    v[5] = v[48] = 1;
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r = run_kernel({"int found = wr_any(v > 0) ? 1 : 0;", {"(wr_real)((WR_SCALAR)(found))"}},
                                         {{"v", v}}, {lanes, fp64});
            for (std::size_t i = 0; i < v.size(); ++i) {
                const std::size_t n = static_cast<std::size_t>(lanes), group = i / n;
                EXPECT_EQ(r[0][i], group == 5 / n || group == 48 / n) << i << ", " << lanes;
            }
        }
}

/// True is 1 on one lane and -1 on several. Masks of both kinds select, combine and negate alike.
TEST(Lanes, MasksSelectCombineAndNegate) {
    const Columns columns{{"a", {0, 1, 2, 3}}, {"b", {3, 2, 1, 0}}};
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r = run_kernel({"wr_mask less = a < b, one = a == 1;",
                                          {"truth(less)", "truth(less & one)", "truth(less | (a == 3))", "truth(!less)",
                                           "truth(wr_to_mask(wr_bits(wr_load_floats(texels, at)) == 0))"}},
                                         columns, {lanes, fp64}, float_planes({columns.at("a")}));
            EXPECT_EQ(r[0], (std::vector<double>{1, 1, 0, 0}));
            EXPECT_EQ(r[1], (std::vector<double>{0, 1, 0, 0}));
            EXPECT_EQ(r[2], (std::vector<double>{1, 1, 0, 1}));
            EXPECT_EQ(r[3], (std::vector<double>{0, 0, 1, 1}));
            EXPECT_EQ(r[4], (std::vector<double>{1, 0, 0, 0}));
        }
}

}  // namespace
}  // namespace wrinkle::test
