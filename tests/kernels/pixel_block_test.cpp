// surface/pixel_block.clh
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

/// In frames of any size that blocks fit into, every pixel is evaluated, with the right coordinates and place in
/// memory.
TEST(PixelBlock, BlocksCoverTheFrame) {
    for (const int lanes : lanes_to_try({8, 16}))
        for (const int width : {4, 5, 7, 16, 31})
            for (const int rows : {lanes / 4, lanes / 4 + 1, 11}) {
                const int across = (width + 3) / 4, down = (rows + lanes / 4 - 1) / (lanes / 4);
                const std::size_t items = static_cast<std::size_t>(across) * static_cast<std::size_t>(down);
                std::vector<float> plane(static_cast<std::size_t>(50 + width * rows));
                for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = static_cast<float>(i);
                const Columns columns{{"nothing", std::vector<float>(items * static_cast<std::size_t>(lanes))}};
                ColumnData data;
                data.texels = plane;
                data.constants = {static_cast<double>(width), static_cast<double>(rows)};
                for (const bool fp64 : precisions_to_try()) {
                    const Results r = run_kernel(
                        {"wr_pixel_block b = wr_pixel_block_of(get_global_id(0), 50, 20, (uint)constants[0], "
                         "(uint)constants[1]);",
                         {"b.x", "b.y", "wr_load(texels, b.in)", "wr_load(texels, b.out)"}},
                        columns, {lanes, fp64}, data);
                    std::vector<int> seen(static_cast<std::size_t>(width * rows));
                    for (std::size_t i = 0; i < r[0].size(); ++i) {
                        const int x = static_cast<int>(r[0][i] - 0.5), y = static_cast<int>(r[1][i] - 20.5);
                        ASSERT_EQ(r[0][i], x + 0.5);
                        ASSERT_EQ(r[1][i], y + 20.5);
                        ASSERT_TRUE(x >= 0 && x < width && y >= 0 && y < rows) << x << ", " << y;
                        ASSERT_EQ(r[2][i], 50 + y * width + x);
                        ASSERT_EQ(r[3][i], y * width + x);
                        ++seen[static_cast<std::size_t>(y * width + x)];
                    }
                    EXPECT_EQ(std::ranges::count(seen, 0), 0)
                        << width << " x " << rows << " pixels on " << lanes << " lanes";
                }
            }
}

/// Where blocks do not fit, pixels are those of wr_pixels_of, each once.
TEST(PixelBlock, RowsWhereBlocksDoNotFit) {
    constexpr std::size_t width = 3, pixels = width * 32;
    std::vector<float> plane(50 + 256);  // work-items are padded to 256 pixels, and here none of them is guarded
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = static_cast<float>(i);
    const Columns columns{{"nothing", std::vector<float>(pixels)}};
    ColumnData data;
    data.texels = plane;
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try()) {
            const Results r = run_kernel({"wr_pixel_block b = wr_pixel_block_of(get_global_id(0), 50, 20, 3, 0);",
                                          {"b.x", "b.y", "wr_load(texels, b.in)", "wr_load(texels, b.out)"}},
                                         columns, {lanes, fp64}, data);
            std::vector<int> seen(pixels);
            for (std::size_t i = 0; i < pixels; ++i) {
                const double pixel = r[3][i];
                ASSERT_EQ(r[0][i], std::fmod(pixel, width) + 0.5) << i << " on " << lanes;
                ASSERT_EQ(r[1][i], std::floor(pixel / width) + 20.5) << i << " on " << lanes;
                ASSERT_EQ(r[2][i], 50 + pixel) << i << " on " << lanes;
                ++seen.at(static_cast<std::size_t>(pixel));
            }
            EXPECT_EQ(std::ranges::count(seen, 1), static_cast<std::ptrdiff_t>(pixels)) << lanes;
        }
}

}  // namespace
}  // namespace wrinkle::test
