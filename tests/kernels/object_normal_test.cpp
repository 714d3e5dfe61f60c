// sources/object_normal.clh, sources/derivative_map.clh: what reads textures. (functions_test.cpp tests the rest.)
#include "tests/cases/height_map.h"

#include "tests/kernels/check.h"
#include "tests/reference/normal_transform.h"

namespace wrinkle::test {
namespace {

TEST(ObjectNormal, RepeatsOrClamps) {
    cases::Cases c{.name = "object normals"};
    cases::Random texels(5);
    reference::Level<real> top{11, 6, {}};
    for (int i = 0; i < 3 * 11 * 6; ++i) top.texels.push_back(texels.uniform(-1, 1));
    const cases::Pyramid vectors = reference::build_pyramid(top, 3);
    for (const cases::Address wrap : {cases::Address::repeat, cases::Address::clamp})
        cases::add_texture(c.data, vectors, 4, [&](const auto& level, int k, int x, int y) {
            return k < 3 ? level.at(k, x, y, wrap) : real{0};
        });
    for (unsigned seed = 1; seed <= 300; ++seed) {
        cases::Random random(seed);
        const V2 st{random.uniform(-2, 3), random.uniform(-2, 3)};
        const V2 held{std::clamp<real>(st.x, 0, 1), std::clamp<real>(st.y, 0, 1)};
        const real lod = seed % 3 == 0 ? real(random.below(4)) : random.uniform(0, 3);
        c.add("object normals, seed " + std::to_string(seed), seed % 2 == 0);
        c.in("st", st), c.in("lod", lod);
        const auto texel = [&](V2 at, cases::Address wrap) {
            const auto channel = [&](int k) { return sample(vectors, k, at, lod, wrap); };
            return V{channel(0), channel(1), channel(2)};
        };
        c.out("repeated", texel(st, cases::Address::repeat)), c.out("clamped", texel(held, cases::Address::clamp));
        c.out("across", std::sqrt(real{66}));
    }
    check(c,
          "wr_texture repeat = wr_texture_at(texels, textures, 0), clamp = wr_texture_at(texels, textures, 1);\n"
          "wr_vec3 a = wr_object_normal(repeat, st, lod), b = wr_object_normal_clamp(clamp, st, lod);",
          {{"repeated", xyz("a"), ErrorMeasure::absolute, 1e-5, 1e-5, 1e-7},
           {"clamped", xyz("b"), ErrorMeasure::absolute, 1e-5, 1e-5, 1e-7},
           {"across", {"wr_texels_across(repeat)"}, ErrorMeasure::relative, 1.2e-7, 1.2e-7, 1e-7}});
}

/// For turned, stretched or mirrored objects a plan computes rows, of cofactors, that turn a normal. The result must be
/// the direction of the cross product of two tangents that the matrix itself has moved.
TEST(ObjectNormal, RowsTurnAVector) {
    cases::Cases c{.name = "turned normals"};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        cases::Random random(seed);
        const V x = random.box(2), y = random.box(2), z = random.box(2), n = random.unit();  // rows of the matrix
        const real det = dot(x, cross(y, z)), sign = det < 0 ? -1 : 1;
        const auto row = [](V v) { return std::array{double(v.x), double(v.y), double(v.z)}; };
        const V rows[] = {cross(y, z) * sign, cross(z, x) * sign, cross(x, y) * sign};
        c.add("turned normals, seed " + std::to_string(seed), seed % 2 == 0);
        const V want = reference::transform_normal({row(x), row(y), row(z)}, n);
        c.allowance.back() = (length(rows[0]) + length(rows[1]) + length(rows[2])) / length(want);
        c.in("a", rows[0]), c.in("b", rows[1]), c.in("c", rows[2]), c.in("n", n);
        c.out("turned", want);
    }
    check(c, "wr_vec3 r = wr_turn(a, b, c, n);", {{"turned", xyz("r"), ErrorMeasure::degrees, 2e-5, 2e-5, 1e-5}});
}

}  // namespace
}  // namespace wrinkle::test
