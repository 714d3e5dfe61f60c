// bins/bin_lists.clh: the lists of a super block and of its children, when there is room for them and when there is
// not.
#include <gtest/gtest.h>

#include <numeric>

#include "device/program.h"
#include "resources/bin_bounds.h"
#include "tests/cases/projector.h"
#include "tests/kernels/kernel_function.h"

namespace wrinkle::test {
namespace {

using cases::Random;
using reference::real;
using V = reference::Vec<real>;

constexpr unsigned kDecals = 1000;

struct Box {
    V low, high;
    bool overlaps(const Box& b) const {
        return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y && low.z <= b.high.z &&
               b.low.z <= high.z;
    }
};

/// A list of decals, as it is stored on the device.
struct List {
    std::vector<unsigned> entries;
    bool own = false;
};

struct Lists {
    std::array<float, 6> around{};
    List super;
    std::vector<List> children;
};

/// Decals that are boxes parallel to the axes, for which the tests of boxes are exact, and 16 children among them.
struct BinSetup {
    std::vector<Box> decals;
    BinBounds bounds;
    std::vector<Box> children;
    std::vector<float> child_planes = std::vector<float>(96);

    BinSetup() {
        std::vector<wr_projector> records;
        for (unsigned i = 0; i < kDecals; ++i) {
            Random random(i + 1);
            const V half{random.uniform(0.1L, 1), random.uniform(0.1L, 1), random.uniform(0.1L, 1)};
            const auto box = reference::decal_box(random.box(10), V{1, 0, 0}, V{0, 1, 0}, half);
            records.push_back(cases::projector_record({}, box));
            const V center{box.center.x, -box.center.y, -box.center.z};  // right, down and forward of the camera below
            decals.push_back({center - half, center + half});
        }
        bounds = bin_bounds(records, Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1, 1));
        for (unsigned k = 0; k < 16; ++k) {
            Random random(5000 + k);
            const V middle = random.box(4), half{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
            const Box box{cases::Random::rounded(middle - half), cases::Random::rounded(middle + half)};
            children.push_back(box);
            const real sides[] = {box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z};
            for (std::size_t plane = 0; plane < 6; ++plane)
                child_planes[16 * plane + k] = static_cast<float>(sides[plane]);
        }
    }

    /// Those decals of `from` that overlap a box, in the same order.
    std::vector<unsigned> overlapping(const Box& box, const std::vector<unsigned>& from) const {
        std::vector<unsigned> out;
        for (const unsigned i : from)
            if (decals[i].overlaps(box)) out.push_back(i);
        return out;
    }
};

Lists lists_of(const BinSetup& setup, unsigned capacity, int lanes) {
    const Device& device = test_device();
    const BuiltProgram built = build_program(
        device,
        "#include \"wrinkle.clh\"\n"
        "wr_kernel void lists(global const float *boxes, global const float *bounds, global const float *groups,\n"
        "    uint decals, global const float *children, global float *around, global uint *super_list,\n"
        "    global uint *child_lists, global uint *entries, global ushort *hits, uint capacity, global uint "
        "*used)\n{\n"
        "    wr_binned all = {boxes, bounds, groups, decals};\n"
        "    wr_bin_around(children, 16, 0, around, 1);\n"
        "    wr_bin_super(all, around, 1, 0, super_list, entries, capacity, used);\n"
        "    wr_bin_children(all, children, 16, 0, super_list, child_lists, entries, hits, capacity, used);\n}\n",
        {lanes, false});
    std::vector<cl_uint> entries(capacity), super(3), children(48), used{kDecals};
    std::iota(entries.begin(), entries.begin() + kDecals, 0u);
    std::vector<cl_ushort> hits(capacity);
    Lists out;
    std::vector<float> around(6);
    const auto buffer = [&](auto& v) {
        return cl::Buffer(device.context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, v.size() * sizeof(v[0]),
                          const_cast<void*>(static_cast<const void*>(v.data())));
    };
    const cl::Buffer buffers[] = {buffer(setup.bounds.boxes),
                                  buffer(setup.bounds.bounds),
                                  buffer(setup.bounds.groups),
                                  buffer(setup.child_planes),
                                  buffer(around),
                                  buffer(super),
                                  buffer(children),
                                  buffer(entries),
                                  buffer(hits),
                                  buffer(used)};
    cl::Kernel kernel(built.program, "lists");
    const cl_uint places[] = {0, 1, 2, 4, 5, 6, 7, 8, 9, 11};
    for (std::size_t i = 0; i < std::size(places); ++i) kernel.setArg(places[i], buffers[i]);
    kernel.setArg(3, cl_uint{kDecals}), kernel.setArg(10, cl_uint{capacity});
    device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1));
    const auto read = [&](const cl::Buffer& from, auto& to) {
        device.queue.enqueueReadBuffer(from, CL_TRUE, 0, to.size() * sizeof(to[0]), to.data());
    };
    read(buffers[4], out.around), read(buffers[5], super), read(buffers[6], children), read(buffers[7], entries);
    const auto list = [&](const cl_uint* words) {
        return List{{entries.begin() + words[0], entries.begin() + words[0] + words[1]}, words[2] != 0};
    };
    out.super = list(super.data());
    for (std::size_t k = 0; k < 16; ++k) out.children.push_back(list(children.data() + 3 * k));
    return out;
}

std::vector<unsigned> everything() {
    std::vector<unsigned> all(kDecals);
    std::iota(all.begin(), all.end(), 0u);
    return all;
}

/// One box at a time, as programs of one lane do it, and sixteen.
class BinLists : public testing::TestWithParam<int> {
protected:
    void SetUp() override {
        if (lanes_to_try({GetParam()}).empty()) GTEST_SKIP() << "not among WRINKLE_TEST_LANES";
    }
};

TEST_P(BinLists, HoldWhatTouchesInTheOrderOfTheTable) {
    const BinSetup setup;
    const Lists got = lists_of(setup, 100'000, GetParam());
    Box around = setup.children[0];
    for (const Box& child : setup.children) {
        around.low = {std::min(around.low.x, child.low.x), std::min(around.low.y, child.low.y),
                      std::min(around.low.z, child.low.z)};
        around.high = {std::max(around.high.x, child.high.x), std::max(around.high.y, child.high.y),
                       std::max(around.high.z, child.high.z)};
    }
    const real sides[] = {around.low.x, around.low.y, around.low.z, around.high.x, around.high.y, around.high.z};
    for (std::size_t k = 0; k < 6; ++k) EXPECT_EQ(got.around[k], static_cast<float>(sides[k]));
    EXPECT_TRUE(got.super.own);
    EXPECT_EQ(got.super.entries, setup.overlapping(around, everything()));
    EXPECT_LT(got.super.entries.size(), kDecals);
    std::size_t listed = 0;
    for (std::size_t k = 0; k < 16; ++k) {
        EXPECT_TRUE(got.children[k].own);
        EXPECT_EQ(got.children[k].entries, setup.overlapping(setup.children[k], got.super.entries)) << "child " << k;
        listed += got.children[k].entries.size();
    }
    EXPECT_GT(listed, 20u);
}

TEST_P(BinLists, TakeTheirParentsWhereThereIsNoRoom) {
    const BinSetup setup;
    const Lists plenty = lists_of(setup, 100'000, GetParam()), none = lists_of(setup, kDecals, GetParam());
    EXPECT_FALSE(none.super.own);
    EXPECT_EQ(none.super.entries, everything());
    const Lists some = lists_of(setup, kDecals + static_cast<unsigned>(plenty.super.entries.size()), GetParam());
    EXPECT_TRUE(some.super.own);
    EXPECT_EQ(some.super.entries, plenty.super.entries);
    for (std::size_t k = 0; k < 16; ++k) {
        EXPECT_FALSE(none.children[k].own);
        EXPECT_EQ(none.children[k].entries, everything());
        EXPECT_FALSE(some.children[k].own);
        EXPECT_EQ(some.children[k].entries, plenty.super.entries);
    }
}

INSTANTIATE_TEST_SUITE_P(Lanes, BinLists, testing::Values(1, 16), testing::PrintToStringParamName());

}  // namespace
}  // namespace wrinkle::test
