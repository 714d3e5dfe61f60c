// compose/mask.clh
#include "tests/reference/mask.h"

#include <gtest/gtest.h>

#include "tests/kernels/kernel_function.h"

namespace wrinkle::test {
namespace {

TEST(Mask, ObjectIndex) {
    const Columns columns{{"object", {3, 0, -3, 3.5f, NAN, INFINITY, 3, 16777216.0f}}};
    for (const int lanes : lanes_to_try()) {
        const Results r = run_kernel({"", {"wr_mask_object(object, 3)", "wr_mask_object(object, 16777216)"}}, columns,
                                     {lanes, false});
        EXPECT_EQ(r[0], (std::vector<double>{1, 0, 0, 0, 0, 0, 1, 0})) << lanes << " lanes";
        EXPECT_EQ(r[1], (std::vector<double>{0, 0, 0, 0, 0, 0, 0, 1})) << lanes << " lanes";
    }
}

/// Ids are compared as bits: a NaN matches itself, -0 is not 0, and denormals are not flushed to 0.
TEST(Mask, CryptomatteComparesBits) {
    const std::uint32_t ids[] = {0x3f800000u,
                                 0x7fc00001u,
                                 0x80000000u,
                                 0x00000000u,
                                 0x00000001u,
                                 0xff800000u,
                                 reference::cryptomatte_bits("Rock"),
                                 reference::cryptomatte_bits("rock")};
    Columns columns;
    for (const std::uint32_t id : ids) {
        columns["id"].push_back(std::bit_cast<float>(id));
        columns["coverage"].push_back(0.75f);
    }
    std::vector<std::string> outputs;
    for (const std::uint32_t wanted : ids)
        outputs.push_back(fmt::format("wr_mask_cryptomatte(wr_load_floats(in_id, at), coverage, {}u)", wanted));
    for (const int lanes : lanes_to_try()) {
        const Results r = run_kernel({"", outputs}, columns, {lanes, false});
        for (std::size_t k = 0; k < std::size(ids); ++k)
            for (std::size_t i = 0; i < std::size(ids); ++i)
                EXPECT_EQ(r[k][i], i == k ? 0.75 : 0)
                    << fmt::format("id {:08x}, wanted {:08x}, {} lanes", ids[i], ids[k], lanes);
    }
}

/// Bumps are for the object in front; where nobody knows it, for who covers nearly all.
TEST(Mask, OnlyTheObjectInFrontIsBumped) {
    const float known = std::bit_cast<float>(0x80000001u);  // bits count, so a denormal is an id
    const Columns columns{{"front", {known, known, known, 0, -0.0f, 0, -0.0f, 0}},
                          {"named", {1, 1, 0, 0, 0, 0, 0, 0}},
                          {"covered", {0.25f, 1, 0.75f, 0.5f, 0.5f, 0.99f, 0.01f, 0}}};
    const auto call = [](int invert) {
        return fmt::format("wr_mask_front(wr_load_floats(in_front, at), named, covered, {})", invert);
    };
    for (const int lanes : lanes_to_try()) {
        const Results r = run_kernel({"", {call(0), call(1)}}, columns, {lanes, false});
        EXPECT_EQ(r[0], (std::vector<double>{0.25, 1, 0, 0, 0, 0.99f, 0, 0})) << lanes << " lanes";
        EXPECT_EQ(r[1], (std::vector<double>{1, 1, 0.75, 1, 1, 1, 0.01f, 0})) << lanes << " lanes";
    }
}

TEST(Mask, ChannelIsClampedAndNanIsNothing) {
    const Columns columns{{"value", {-1, 0, 0.25f, 1, 7, NAN, INFINITY, -INFINITY, -0.0f}}};
    for (const bool fp64 : precisions_to_try())
        for (const int lanes : lanes_to_try())
            EXPECT_EQ(run_kernel({"", {"wr_mask_channel(value)"}}, columns, {lanes, fp64})[0],
                      (std::vector<double>{0, 0, 0.25, 1, 1, 0, 1, 0, 0}))
                << lanes << " lanes";
}

}  // namespace
}  // namespace wrinkle::test
