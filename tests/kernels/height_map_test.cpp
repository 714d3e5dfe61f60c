// sources/height_map.clh
#include "tests/cases/height_map.h"

#include "tests/kernels/check.h"

namespace wrinkle::test {
namespace {

const std::vector<std::string> includes{"sources/texture.clh", "sources/height_map.clh"};
const std::string textures_of_the_row =
    "wr_texture heights = wr_texture_at(texels, textures, (uint)constants[0]);\n"
    "wr_texture slopes = wr_texture_at(texels, textures, (uint)constants[0] + 1);\n"
    "vec2 texel = wr_v2(1 / wr_texture_width(heights), 1 / wr_texture_height(heights));\n";

KernelData data_of(const cases::TextureCases& c) {
    KernelData data;
    data.constants = c.numbers;
    data.constants_per_row = 1;
    data.texels = c.texels;
    data.textures = c.table;
    return data;
}

Answer slope_answer(const std::string& name, const std::string& slope, double fp64) {
    const double bound = cases::height_slope_absolute;
    return {name, {slope + ".x * texel.x", slope + ".y * texel.y"}, Metric::absolute, bound, bound, fp64};
}

void check_slopes(const cases::TextureCases& c, const std::string& form, const std::string& textures) {
    // Texels and lods are floats, so double runs keep only their digits.
    check(c.cases, includes, textures_of_the_row + "vec2 d = " + form + "(" + textures + ", st, lod);",
          {slope_answer(form.starts_with("wr_slope") ? "smooth" : "plain", "d", 1e-6)}, data_of(c), INFINITY);
}

TEST(HeightMap, Lod) {
    const cases::TextureCases c = cases::height_slope_cases();
    check(c.cases, includes, textures_of_the_row + "real l = wr_texture_lod(heights, dSTdx, dSTdy);",
          {{"lod", {"l"}, Metric::absolute, 1e-6, 1e-6}}, data_of(c), INFINITY);
}

TEST(HeightMap, PlainRepeated) { check_slopes(cases::height_slope_cases(), "wr_height_slope_plain", "heights"); }
TEST(HeightMap, PlainClamped) { check_slopes(cases::clamped_slope_cases(), "wr_height_slope_plain_clamp", "heights"); }
TEST(HeightMap, SmoothRepeated) { check_slopes(cases::height_slope_cases(), "wr_slope", "slopes"); }
TEST(HeightMap, SmoothClamped) { check_slopes(cases::clamped_slope_cases(), "wr_slope_clamp", "slopes"); }

}  // namespace
}  // namespace wrinkle::test
