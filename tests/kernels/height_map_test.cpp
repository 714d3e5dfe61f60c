// sources/height_map.clh with textures that are clamped. (functions_test.cpp tests those that repeat.)
#include "tests/cases/height_map.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

constexpr double bound = 2e-5;  // heights per texel

std::string slope_text(int texture, const std::string& form) {
    return fmt::format(
        "wr_texture t = wr_texture_at(texels, textures, {});\n"
        "wr_vec2 d = {}(t, st, lod);\n"
        "d = wr_v2(d.x / wr_texture_width(t), d.y / wr_texture_height(t));",
        texture, form);
}

// Texels and levels of detail are floats in double runs, too, which limits how exact those can be.
TEST(HeightMap, PlainClamped) {
    check(cases::clamped_slope_cases(), slope_text(0, "wr_height_slope_plain_clamp"),
          {{"plain", xy("d"), ErrorMeasure::absolute, bound, bound, 1e-6}});
}

TEST(HeightMap, SmoothClamped) {
    check(cases::clamped_slope_cases(), slope_text(1, "wr_slope_clamp"),
          {{"smooth", xy("d"), ErrorMeasure::absolute, bound, bound, 1e-6}});
}

TEST(HeightMap, Lod) {
    check(cases::height_slope_cases(false),
          "wr_texture t = wr_texture_at(texels, textures, (uint)constants[0]);\n"
          "wr_levels l = wr_texture_levels(t, wr_texture_lod(t, dst_dx, dst_dy));",
          {{"lod", {"wr_to_real(l.fine) + l.weight"}, ErrorMeasure::absolute, 1e-6, 1e-6}});
}

}  // namespace
}  // namespace wrinkle::test
