// bins/bin_tests.clh: the numbering of tiles, the boxes around them, and which decals may touch which tile.
#include <gtest/gtest.h>

#include <set>

#include "device/program.h"
#include "resources/bin_bounds.h"
#include "tests/cases/projector.h"
#include "tests/kernels/kernel_function.h"

namespace wrinkle::test {
namespace {

using cases::Random;
using reference::DecalBox;
using reference::real;
using V = reference::Vec<real>;

TEST(BinTests, EveryPixelLiesInTheTileOfItsNumber) {
    ColumnKernel f;
    f.body =
        "wr_index tile = wr_tile_number(wr_to_index(x), wr_to_index(y), 3);\n"
        "wr_real left = 0, top = 0;\n"
        "wr_each_lane(k) {\n"
        "    uint2 corner = wr_tile_corner((uint)wr_lane(tile, k), 3);\n"
        "    wr_lane(left, k) = corner.x, wr_lane(top, k) = corner.y;\n}";
    f.outputs = {"left", "top"};
    cases::Columns columns;
    for (int y = 0; y < 300; y += 3)
        for (int x = 0; x < 768; x += 5)
            columns["x"].push_back(static_cast<float>(x)), columns["y"].push_back(static_cast<float>(y));
    for (const int lanes : lanes_to_try({1, 8})) {
        const Results got = run_kernel(f, columns, {lanes, false});
        for (std::size_t i = 0; i < columns["x"].size(); ++i) {
            EXPECT_EQ(got[0][i], std::floor(columns["x"][i] / 16) * 16) << columns["x"][i] << ", " << columns["y"][i];
            EXPECT_EQ(got[1][i], std::floor(columns["y"][i] / 8) * 8) << columns["x"][i] << ", " << columns["y"][i];
        }
    }
}

TEST(BinTests, TilesBelongToTheirBlocksAndSuperBlocks) {
    ColumnKernel f;
    f.body =
        "wr_index tile = wr_tile_number(wr_to_index(x), wr_to_index(y), 3);\n"
        "wr_real number = 0;\nwr_each_lane(k) wr_lane(number, k) = (WR_SCALAR)wr_lane(tile, k);";
    f.outputs = {"number"};
    cases::Columns columns;
    for (int y = 0; y < 256; y += 8)
        for (int x = 0; x < 768; x += 16)
            columns["x"].push_back(static_cast<float>(x)), columns["y"].push_back(static_cast<float>(y));
    const Results got = run_kernel(f, columns, {8, false});
    std::set<double> numbers;
    for (std::size_t i = 0; i < got[0].size(); ++i) {
        const int number = static_cast<int>(got[0][i]), x = static_cast<int>(columns["x"][i]),
                  y = static_cast<int>(columns["y"][i]);
        numbers.insert(number);
        EXPECT_EQ(number >> 8, y / 128 * 3 + x / 256) << "super block of " << x << ", " << y;
        EXPECT_EQ(number >> 4 & 15, y / 32 % 4 * 4 + x / 64 % 4) << "block of " << x << ", " << y;
    }
    EXPECT_EQ(numbers.size(), got[0].size()) << "no two tiles share a number";
}

TEST(BinTests, ABoxHoldsTheValidPointsAndTheirSlack) {
    ColumnKernel f;
    f.body =
        "constant const WR_SCALAR *axes = constants;\n"
        "wr_growing box = wr_grow(wr_no_box(), use > 0, p, axes);\n"
        "wr_growing none = wr_grow(wr_no_box(), use > 2, p, axes);";
    f.outputs = {"box.low.x", "box.high.x", "box.low.y", "box.high.y", "truth(none.low.z > none.high.z)"};
    ColumnData data;
    data.constants = {0, 1, 0, -1, 0, 0, 0, 0, 1};  // a quarter turn
    const Results got =
        run_kernel(f, {{"p.x", {3, 3}}, {"p.y", {-5, -5}}, {"p.z", {100, 100}}, {"use", {1, 0}}}, {8, false}, data);
    EXPECT_LE(got[0][0], -5);
    EXPECT_GE(got[1][0], -5);
    EXPECT_NEAR(got[0][0], -5, 1e-3);
    EXPECT_LE(got[2][0], -3);
    EXPECT_GE(got[3][0], -3);
    EXPECT_NEAR(got[3][0], -3, 1e-3);
    EXPECT_LT(got[0][0], got[1][0]) << "100 away, positions are not exact";
    EXPECT_GT(got[0][1], got[1][1]) << "an invalid pixel adds nothing";
    EXPECT_EQ(got[4][0], 1);
}

/// For each decal, which of the 16 boxes the device says that it may touch.
std::vector<unsigned> touches(const std::vector<float>& decals, const std::vector<float>& bounds, std::size_t count,
                              int lanes) {
    const Device& device = test_device();
    const BuiltProgram built = build_program(
        device,
        "#include \"wrinkle.clh\"\n"
        "wr_kernel void touches(global const float *decals, global const float *bounds, global uint *out)\n{\n"
        "    uint i = get_global_id(0);\n"
        "    out[i] = wr_touches16(decals + WR_BOX_NUMBERS * i, bounds + 96 * i, 16, 0);\n}\n",
        {lanes, false});
    std::vector<unsigned> out(count);
    const auto input = [&](const std::vector<float>& v) {
        return cl::Buffer(device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, v.size() * sizeof(float),
                          const_cast<float*>(v.data()));
    };
    cl::Buffer a = input(decals), b = input(bounds), c(device.context, CL_MEM_READ_WRITE, count * sizeof(cl_uint));
    cl::Kernel kernel(built.program, "touches");
    kernel.setArg(0, a), kernel.setArg(1, b), kernel.setArg(2, c);
    device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(count));
    device.queue.enqueueReadBuffer(c, CL_TRUE, 0, count * sizeof(cl_uint), out.data());
    return out;
}

/// Between world space and the axes of bounds (right, down, forward) of a camera that looks along -z. It is its own
/// inverse.
V turned(V p) { return {p.x, -p.y, -p.z}; }

/// Random decals, and boxes near them. No box with a point of the decal may be missed, and most of the boxes that are
/// said to touch must have such a point.
TEST(BinTests, ADecalIsNeverMissedAndSeldomFoundForNothing) {
    constexpr std::size_t count = 300;
    std::vector<Projector> rows(count);
    std::vector<DecalBox<real>> boxes;
    std::vector<wr_projector> records;
    std::vector<float> bounds;
    std::vector<std::array<std::pair<V, V>, 16>> corners(count);
    for (unsigned i = 0; i < count; ++i) {
        Random random(i + 1);
        rows[i].shape = static_cast<ProjectorShape>(i % 3);
        rows[i].falloff = {0, 0, 0};
        const V half{random.magnitude(-1, 0), random.magnitude(-1, 0), random.magnitude(-1, 0)};
        boxes.push_back(reference::decal_box(random.box(20), random.unit(), random.unit(), half));
        records.push_back(cases::projector_record(rows[i], boxes[i]));
        std::array<std::array<float, 16>, 6> planes{};
        for (std::size_t k = 0; k < 16; ++k) {
            const V size = random.box(1) * random.magnitude(-1.5L, 0.3L),
                    middle = turned(boxes[i].center) + random.box(1.5L);
            const real center[] = {middle.x, middle.y, middle.z},
                       extent[] = {std::abs(size.x), std::abs(size.y), std::abs(size.z)};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                planes[axis][k] = static_cast<float>(center[axis] - extent[axis]);
                planes[axis + 3][k] = static_cast<float>(center[axis] + extent[axis]);
            }
            corners[i][k] = {V{planes[0][k], planes[1][k], planes[2][k]}, V{planes[3][k], planes[4][k], planes[5][k]}};
        }
        for (const auto& plane : planes) bounds.insert(bounds.end(), plane.begin(), plane.end());
    }
    const Camera upright = Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1, 1);
    const BinBounds decals = bin_bounds(records, upright);
    std::vector<std::vector<unsigned>> got;  // one box at a time, and sixteen
    for (const int lanes : lanes_to_try({1, 16})) got.push_back(touches(decals.boxes, bounds, count, lanes));
    std::size_t touching = 0, listed = 0, missed = 0;
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < 16; ++k) {
            const auto [low, high] = corners[i][k];
            bool found = false;
            Random random(static_cast<unsigned>(1000 + 16 * i + k));
            for (int sample = 0; sample < 400 && !found; ++sample) {
                const V p{random.uniform(low.x, high.x), random.uniform(low.y, high.y), random.uniform(low.z, high.z)};
                found = reference::project(rows[i], boxes[i], turned(p)).weight > 0;
            }
            for (const std::vector<unsigned>& touched : got) {
                touching += found ? 1 : 0;
                listed += touched[i] >> k & 1;
                missed += found && (touched[i] >> k & 1) == 0 ? 1 : 0;
            }
        }
    }
    fmt::print("{} of {} boxes touch, {} are listed\n", touching, 16 * count * got.size(), listed);
    EXPECT_EQ(missed, 0u);
    EXPECT_GT(touching, 300u);
    EXPECT_LT(listed, 2 * touching);
}

}  // namespace
}  // namespace wrinkle::test
