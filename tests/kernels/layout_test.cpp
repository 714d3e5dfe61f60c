// layout.h: structs have the same members at the same places on the host and on the device.
#include <gtest/gtest.h>

#include <numeric>

#include "device/kernel_sources.h"
#include "functions/kernel_listing.h"
#include "resources/frame_constants.h"
#include "tests/kernels/kernel_function.h"

namespace wrinkle::test {
namespace {

/// A number of a member as kernel text, and what the host finds in it when number i of the struct is i + 1.
struct Member {
    std::string text;
    double value;
    std::string name;
};

template <class Struct>
Struct counted() {
    Struct s;
    std::vector<double> numbers(sizeof(Struct) / sizeof(double));
    std::iota(numbers.begin(), numbers.end(), 1);
    std::memcpy(&s, numbers.data(), sizeof s);
    return s;
}

template <std::size_t n>
void add(std::vector<Member>& members, const std::string& name, const double (&values)[n]) {
    for (std::size_t k = 0; k < n; ++k) members.push_back({fmt::format("s->{}[{}]", name, k), values[k], name});
}
void add(std::vector<Member>& members, const std::string& name, double value) {
    members.push_back({"s->" + name, value, name});
}

#define MEMBER(m) add(members, #m, s.m)

/// The table of the reference page has every member at the place where the compiler puts it.
void check_table(const std::string& type, const std::vector<Member>& members) {
    for (const LayoutStruct& layout : layout_structs(kernel_source("layout.h"))) {
        if (layout.name != type) continue;
        ASSERT_EQ(layout.size, members.size()) << type;
        for (const LayoutMember& row : layout.members) {
            EXPECT_FALSE(row.meaning.empty()) << type << '.' << row.name;
            for (std::size_t k = 0; k < row.count; ++k) {
                EXPECT_EQ(members[row.offset + k].name, row.name) << type;
                EXPECT_EQ(members[row.offset + k].value, static_cast<double>(row.offset + k + 1)) << type;
            }
        }
        return;
    }
    ADD_FAILURE() << type << " is not in the table";
}

/// Reads every member on the device, as float and as double, from constant and from global memory.
void check_layout(const std::string& type, const std::vector<Member>& members, std::size_t size) {
    ASSERT_EQ(members.size() * sizeof(double), size) << type << ": a member is not named in this test";
    check_table(type, members);
    ColumnData data;
    data.constants.resize(size / sizeof(double));
    std::iota(data.constants.begin(), data.constants.end(), 1);
    data.records = data.constants;
    for (const char* memory : {"constant", "global"})
        for (const bool fp64 : precisions_to_try()) {
            ColumnKernel f;
            f.body = fmt::format("{0} const {1} *s = ({0} const {1} *){2};", memory, type,
                                 std::string(memory) == "constant" ? "constants" : "records");
            f.outputs = {fmt::format("(wr_real)(sizeof({}) / sizeof(WR_SCALAR))", type)};
            for (const Member& m : members) f.outputs.push_back(fmt::format("(wr_real)({})", m.text));
            const Results r = run_kernel(f, {{"nothing", {0}}}, {8, fp64}, data);
            EXPECT_EQ(r[0][0], static_cast<double>(members.size())) << type;
            for (std::size_t i = 0; i < members.size(); ++i)
                EXPECT_EQ(r[i + 1][0], members[i].value) << type << ", " << members[i].text << ", " << memory;
        }
}

TEST(Layout, Frame) {
    const auto s = counted<wr_camera>();
    std::vector<Member> members;
    MEMBER(width), MEMBER(height), MEMBER(eye_high), MEMBER(eye_low), MEMBER(d0), MEMBER(dx), MEMBER(dy);
    MEMBER(dx_cross_d0), MEMBER(dx_cross_dy), MEMBER(dy_cross_d0), MEMBER(dy_cross_dx);
    MEMBER(c0), MEMBER(c1), MEMBER(c2), MEMBER(c3), MEMBER(w), MEMBER(forward);
    MEMBER(d0_low), MEMBER(dx_low), MEMBER(dy_low);
    MEMBER(c0_low), MEMBER(c1_low), MEMBER(c2_low), MEMBER(c3_low), MEMBER(w_low);
    MEMBER(depth_scale), MEMBER(depth_offset), MEMBER(depth_offset_low);
    check_layout("wr_camera", members, sizeof s);
}

TEST(Layout, Projector) {
    const auto s = counted<wr_projector>();
    std::vector<Member> members;
    MEMBER(center), MEMBER(to_box_x), MEMBER(to_box_y), MEMBER(to_box_z), MEMBER(strength), MEMBER(repeat);
    MEMBER(falloff), MEMBER(fade_slope), MEMBER(fade_zero), MEMBER(two_sided), MEMBER(shape), MEMBER(per_size);
    MEMBER(texture), MEMBER(tile), MEMBER(opacity), MEMBER(replace), MEMBER(mask), MEMBER(object), MEMBER(object_low);
    MEMBER(unused);
    check_layout("wr_projector", members, sizeof s);
}

TEST(Layout, Light) {
    const auto s = counted<wr_light>();
    std::vector<Member> members;
    MEMBER(kind), MEMBER(color), MEMBER(position), MEMBER(fade), MEMBER(to_light), MEMBER(shape);
    MEMBER(diffuse), MEMBER(specular);
    check_layout("wr_light", members, sizeof s);
}

TEST(Layout, Lighting) {
    const auto s = counted<wr_lighting>();
    std::vector<Member> members;
    MEMBER(sky), MEMBER(albedo), MEMBER(roughness), MEMBER(f0), MEMBER(max_ratio), MEMBER(lights);
    MEMBER(shadow);
    check_layout("wr_lighting", members, sizeof s);
}

}  // namespace
}  // namespace wrinkle::test
