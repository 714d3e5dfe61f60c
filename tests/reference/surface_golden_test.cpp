// The references of the single listings against the golden tables (113-bit evaluations of the published formulas).
#include <gtest/gtest.h>

#include "tests/reference/golden.h"
#include "tests/reference/parallax.h"
#include "tests/reference/perturbed_normal.h"
#include "tests/reference/resolve.h"
#include "tests/reference/scale_dependent.h"
#include "tests/reference/screen_derivative.h"
#include "tests/reference/tangent_frame.h"
#include "tests/reference/tangent_normal.h"
#include "tests/reference/tbn.h"
#include "tests/reference/vertex_frame.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::reference {
namespace {

/// In hard rows, up to nine of the nineteen digits of long double cancel (n.v when v is perpendicular, world offsets of
/// 1e6).
real tolerance(const GoldenTable& table, std::size_t row) {
    return table.text(row, "set") == "regular" ? 1e-12L : 1e-10L;
}

/// Compares an answer with the table's, if the table has one.
void expect_vec(const GoldenTable& table, std::size_t row, Vec<real> got, const std::string& want) {
    const Vec<real> w = table.vec(row, want);
    if (!finite(w)) return;
    EXPECT_LE(relative_error(got, w), tolerance(table, row)) << want << ", " << table.label(row);
}

Vec<real> unit_normal(const GoldenTable& table, std::size_t row) { return normalize(table.vec(row, "n")); }

TexDerivative<real> st_derivative(const GoldenTable& table, std::size_t row) {
    return {table.vec2(row, "dSTdx"), table.vec2(row, "dSTdy")};
}

TEST(Golden, Resolve) {
    const GoldenTable table = golden("listing01_resolve");
    for (std::size_t i = 0; i < table.size(); ++i)
        expect_vec(table, i, resolve(table.vec(i, "n"), table.vec(i, "sg")), "want_N");
}

TEST(Golden, TangentNormal) {
    const GoldenTable table = golden("listing02_tspace_to_deriv");
    for (std::size_t i = 0; i < table.size(); ++i)
        for (const bool flip : {false, true}) {
            const Vec2<real> d = slope_from_tangent_normal(table.vec(i, "vM"), flip);
            const Vec2<real> want = table.vec2(i, flip ? "want_flip1_d" : "want_flip0_d");
            EXPECT_TRUE(finite(d)) << table.label(i);
            if (!finite(want)) continue;
            EXPECT_LE(relative_error(d, want), tolerance(table, i)) << table.label(i);
        }
}

TEST(Golden, Tbn) {
    const GoldenTable table = golden("listing03_surfgrad_tbn");
    for (std::size_t i = 0; i < table.size(); ++i)
        expect_vec(table, i, surface_gradient_from_tbn(table.vec2(i, "d"), table.vec(i, "T"), table.vec(i, "B")),
                   "want_sg");
}

TEST(Golden, TangentFrame) {
    const GoldenTable table = golden("listing04_genbasis_tb");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> n = unit_normal(table, i), dp_dx = table.vec(i, "dPdx"), dp_dy = table.vec(i, "dPdy");
        expect_vec(table, i, tangent_part(dp_dx, n), "want_sigmaX");
        expect_vec(table, i, tangent_part(dp_dy, n), "want_sigmaY");
        EXPECT_EQ(flip_sign(n, dp_dx, dp_dy), table.number(i, "want_flip_sign")) << table.label(i);
        const TangentFrame<real> frame = tangent_frame(n, dp_dx, dp_dy, st_derivative(table, i));
        if (frame.degenerate) continue;
        expect_vec(table, i, frame.tangent, "want_T");
        expect_vec(table, i, frame.bitangent, "want_B");
    }
}

TEST(Golden, PerturbedNormal) {
    const GoldenTable table = golden("listing05_perturbed_normal");
    for (std::size_t i = 0; i < table.size(); ++i)
        expect_vec(table, i, surface_gradient_from_normal(unit_normal(table, i), table.vec(i, "v")), "want_sg");
}

TEST(Golden, ScaleDependent) {
    const GoldenTable table = golden("listing06_scale_dependent");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> n = unit_normal(table, i), dp_dx = table.vec(i, "dPdx"), dp_dy = table.vec(i, "dPdy");
        const Vec2<real> d = table.vec2(i, "deriv"), dim = table.vec2(i, "dim");
        const Vec2<real> per_unit{d.x * dim.x, d.y * dim.y};
        expect_vec(table, i, surface_gradient_scale_dependent(n, dp_dx, dp_dy, st_derivative(table, i), per_unit),
                   "want_sg");
        expect_vec(table, i, surface_gradient_from_screen_slope(n, dp_dx, dp_dy, d), "want_sgScr");
    }
}

TEST(Golden, Prologue) {
    const GoldenTable table = golden("listing09_prologue");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const Vec<real> n = table.vec(i, "In_n"), dp_dx = table.vec(i, "dPdx"), dp_dy = table.vec(i, "dPdy");
        const auto frame = vertex_frame(n, table.vec(i, "In_t"), real{table.number(i, "In_t.w")});
        expect_vec(table, i, frame.tangent, "want_mT");
        expect_vec(table, i, frame.bitangent, "want_mB");
        const Vec<real> base = normalize(n) * (table.number(i, "isFlip") != 0 ? real(-1) : real(1));
        expect_vec(table, i, base, "want_n");
        expect_vec(table, i, tangent_part(dp_dx, base), "want_sX");
        expect_vec(table, i, tangent_part(dp_dy, base), "want_sY");
        EXPECT_EQ(flip_sign(base, dp_dx, dp_dy), table.number(i, "want_flip_sign")) << table.label(i);
    }
}

TEST(Golden, VolumeGradient) {
    const GoldenTable table = golden("listing08_volume_gradient");
    for (std::size_t i = 0; i < table.size(); ++i)
        expect_vec(table, i, surface_gradient_from_volume(unit_normal(table, i), table.vec(i, "g")), "want_sg");
}

TEST(Golden, ProjectToTexture) {
    const GoldenTable table = golden("listing11_project_vec_to_tex");
    for (std::size_t i = 0; i < table.size(); ++i)
        for (const bool projected : {false, true}) {
            const Vec2<real> along =
                project_to_texture(unit_normal(table, i), table.vec(i, "dPdx"), table.vec(i, "dPdy"),
                                   st_derivative(table, i), table.vec(i, "dir"), projected);
            const Vec2<real> got = along * real{table.number(i, "bumpScale")};
            const Vec2<real> want = table.vec2(i, projected ? "want_v" : "want_vSkip");
            EXPECT_TRUE(finite(got)) << table.label(i);
            if (!finite(want)) continue;
            EXPECT_LE(relative_error(got, want), tolerance(table, i)) << table.label(i);
        }
}

TEST(Golden, TextureOffsetToSurface) {
    const GoldenTable table = golden("listing12_tex_offs_to_surface");
    for (std::size_t i = 0; i < table.size(); ++i)
        expect_vec(table, i,
                   texture_offset_to_surface(table.vec(i, "sigmaX"), table.vec(i, "sigmaY"), st_derivative(table, i),
                                             table.vec2(i, "offs")),
                   "want_d");
}

TEST(Golden, ScreenDerivative) {
    const GoldenTable table = golden("listing10_screenderiv_noddxy");
    for (std::size_t i = 0; i < table.size(); ++i) {
        Mat4x4<real> m;
        for (int r = 0; r < 4; ++r)
            for (int c = 0; c < 4; ++c) m[r][c] = table.number(i, "M" + std::to_string(r) + std::to_string(c));
        const ScreenDerivative<real> d = screen_derivative<real>(table.vec(i, "pos"), unit_normal(table, i), m,
                                                                 table.number(i, "x0"), table.number(i, "y0"));
        expect_vec(table, i, d.dp_dx, "want_dPdx");
        expect_vec(table, i, d.dp_dy, "want_dPdy");
    }
}

}  // namespace
}  // namespace wrinkle::reference
