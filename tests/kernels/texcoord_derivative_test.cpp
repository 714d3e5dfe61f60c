// surface/texcoord_derivative.clh, surface/height_derivative.clh, surface/normal_derivative.clh
#include "tests/cases/neighbours.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

TEST(TexcoordDerivative, DifferenceOfNeighbours) {
    check(cases::neighbour_cases(),
          "wr_vec2 half_half = wr_v2((wr_real)(0.5f), (wr_real)(0.5f));\n"
          "wr_neighbour here = {half_half, wr_zero3(), wr_v3((wr_real)(0), (wr_real)(0), (wr_real)(1)), 3, here_valid "
          "!= 0};\n"
          "wr_neighbour before = {beforeUV, beforeP, beforeN, before_object, before_valid != 0};\n"
          "wr_neighbour after = {afterUV, afterP, afterN, after_object, after_valid != 0};\n"
          "wr_mask usable = dp.x == dp.x;\n"
          "wr_texcoord_change d = wr_texcoord_difference(here, before, after, dp, &usable);",
          {{"difference", xy("d.uv"), ErrorMeasure::absolute, 1e-8, 1e-8},
           {"step", xyz("d.p"), ErrorMeasure::absolute, 1e-8, 1e-8},
           {"usable", {"truth(usable)"}, ErrorMeasure::absolute, 0, 0, 0}});
}

TEST(HeightDerivative, DifferenceOfNeighbours) {
    check(cases::height_neighbour_cases(),
          "wr_neighbour here = {wr_v2(here_height, here_height), wr_zero3(), wr_v3((wr_real)(0), (wr_real)(0), "
          "(wr_real)(1)), 3,\n"
          "                     here_valid != 0};\n"
          "wr_neighbour before = {wr_v2(before_height, before_height), beforeP, beforeN, before_object,\n"
          "                       before_valid != 0};\n"
          "wr_neighbour after = {wr_v2(after_height, after_height), afterP, afterN, after_object, after_valid != 0};\n"
          "wr_mask usable = dp.x == dp.x;\n"
          "wr_real d = wr_height_difference(here, before, after, dp, &usable);",
          {{"difference", {"d"}, ErrorMeasure::absolute, 3e-7, 3e-7},
           {"usable", {"truth(usable)"}, ErrorMeasure::absolute, 0, 0, 0}});
}

TEST(NormalDerivative, DifferenceOfNeighbours) {
    check(
        cases::normal_neighbour_cases(),
        "wr_vec2 none = wr_v2((wr_real)(0), (wr_real)(0));\n"
        "wr_neighbour here = {none, wr_zero3(), wr_v3((wr_real)(0), (wr_real)(0), (wr_real)(1)), 3, here_valid != 0};\n"
        "wr_neighbour before = {none, beforeP, beforeN, before_object, before_valid != 0};\n"
        "wr_neighbour after = {none, afterP, afterN, after_object, after_valid != 0};\n"
        "wr_vec3 d = wr_normal_difference(here, before, after, dp);",
        {{"difference", xyz("d"), ErrorMeasure::absolute, 3e-7, 3e-7}});
}

TEST(TexcoordDerivative, LinearMaps) {
    cases::Cases c{.name = "linear texture coordinates"};
    const double m[] = {0.75, -1.5, 2, 0.25, 10, -3};
    for (unsigned seed = 1; seed <= 64; ++seed) {
        cases::Random random(seed);
        const V2 st{random.uniform(-9, 9), random.uniform(-9, 9)}, dx{random.uniform(-1, 1), random.uniform(-1, 1)};
        c.add("linear coordinates, seed " + std::to_string(seed), false);
        c.in("c", st), c.in("dx", dx);
        c.out("st", V2{m[0] * st.x + m[1] * st.y + m[4], m[2] * st.x + m[3] * st.y + m[5]});
        c.out("dx", V2{m[0] * dx.x + m[1] * dx.y, m[2] * dx.x + m[3] * dx.y});
    }
    c.data.constants.assign(std::begin(m), std::end(m));
    check(c,
          "wr_texcoord in_uv = {c, dx, dx};\n"
          "wr_texcoord a = wr_transform(in_uv, constants[0], constants[1], constants[2], constants[3], constants[4],\n"
          "                             constants[5]);",
          {{"st", xy("a.st"), ErrorMeasure::absolute, 5e-6, 0},
           {"dx", xy("a.dx"), ErrorMeasure::absolute, 5e-7, 0},
           {"dx", xy("a.dy"), ErrorMeasure::absolute, 5e-7, 0}});
}

}  // namespace
}  // namespace wrinkle::test
