#pragma once

#include "tests/cases/height_map.h"
#include "tests/cases/surface_derivatives.h"
#include "tests/reference/parallax.h"

namespace wrinkle::cases {

/// Listing 11: with and without the projection.
inline Cases project_to_texture_cases() {
    Cases c{.name = "listing11_project_vec_to_tex"};
    const auto answer = [&](const SurfaceDerivatives& d, V dir) {
        add_inputs(c, d), c.in("dir", dir);
        const auto project = [&](bool projected) {
            return reference::project_to_texture(normalize(d.n), d.dp_dx, d.dp_dy, d.st, normalize(dir), projected);
        };
        c.out("along", project(false)), c.out("climbing", project(true));
    };
    const GoldenTable table = reference::golden("listing11_project_vec_to_tex");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        answer(golden_derivatives(table, i), table.vec(i, "dir"));
    }
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        c.add("project to texture, any footprint, seed " + std::to_string(seed), true);
        const SurfaceDerivatives d = random_derivatives(random);
        answer(d, random.unit());
    }
    for (unsigned seed = 1; seed <= 20; ++seed) {  // a footprint without area: there is no direction in the texture
        Random random(seed);
        SurfaceDerivatives d = random_derivatives(random);
        d.dp_dy = seed % 2 ? V{} : d.dp_dx;
        c.add("project to texture, parallel footprint, seed " + std::to_string(seed), true);
        answer(d, random.unit());
        c.want["along"].back() = c.want["climbing"].back() = V{};
    }
    return c;
}

/// Listing 12.
inline Cases texture_offset_cases() {
    Cases c{.name = "listing12_tex_offs_to_surface"};
    const auto answer = [&](V dp_dx, V dp_dy, const reference::TexDerivative<real>& st, V2 offset) {
        c.in("dp_dx", dp_dx), c.in("dp_dy", dp_dy), c.in("dst_dx", st.dx), c.in("dst_dy", st.dy);
        c.in("offset", offset);
        c.out("step", reference::texture_offset_to_surface(dp_dx, dp_dy, st, offset));
    };
    const GoldenTable table = reference::golden("listing12_tex_offs_to_surface");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        answer(table.vec(i, "sigmaX"), table.vec(i, "sigmaY"), {table.vec2(i, "dSTdx"), table.vec2(i, "dSTdy")},
               table.vec2(i, "offs"));
    }
    for (unsigned seed = 1; seed <= 320; ++seed) {
        Random random(seed);
        SurfaceDerivatives d = random_derivatives(random);
        if (seed > 300) d.st.dy = seed % 2 ? V2{0, 0} : d.st.dx;  // degenerate coordinates: there is no step
        const real size = random.magnitude(-6, 1);
        c.add("texture offset, any footprint, seed " + std::to_string(seed), true);
        answer(d.dp_dx, d.dp_dy, d.st,
               {static_cast<float>(size * random.uniform(-1, 1)), static_cast<float>(size * random.uniform(-1, 1))});
    }
    return c;
}

/// Smooth hills, and noise that a ray may graze. An answer is compared only where neighbouring rays find nearly the
/// same point: where a ray grazes a peak, rounding decides what it hits.
inline Cases parallax_march_cases() {
    Cases c{.name = "parallax march"};
    c.data.constants_per_row = 4;  // the texture, steps, refine, level
    Random texels(11);
    reference::Level<real> hills{64, 32, {}}, rough{16, 16, {}};
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            hills.texels.push_back(
                static_cast<float>(0.5L + 0.35L * std::sin(x * 0.19634954L) * std::cos(y * 0.19634954L)));
    for (int i = 0; i < 16 * 16; ++i) rough.texels.push_back(texels.uniform(-0.1L, 1.1L));  // some beyond [0,1]
    const Pyramid pyramids[] = {reference::build_pyramid(hills, 1), reference::build_pyramid(rough, 1)};
    for (const Pyramid& pyramid : pyramids)
        add_texture(c.data, pyramid, 1,
                    [&](const auto& level, int, int x, int y) { return level.at(0, x, y, Address::repeat); });
    for (unsigned seed = 1; seed <= 500; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const Pyramid& pyramid = pyramids[hard];
        const V2 st{random.uniform(0, 1), random.uniform(0, 1)};
        const real reach = hard ? random.magnitude(-4, 0.5L) : random.magnitude(-2, -0.7L);
        V2 range{static_cast<float>(reach * random.uniform(-1, 1)), static_cast<float>(reach * random.uniform(-1, 1))};
        if (seed % 50 == 0) range = {0, 0};
        const real lod = seed % 3 == 0 ? random.uniform(0, 4) : 0;
        const int steps = hard ? 1 + random.below(64) : 32, refine = hard ? random.below(6) : 3;
        const real level = hard ? random.uniform(0, 1) : real(seed % 4 == 1);
        const auto height = [&](V2 from, V2 over) {
            return reference::parallax_march(
                [&](V2 at) { return reference::sample(pyramid, 0, at, lod, Address::repeat); }, from, over, level,
                reference::parallax_step(pyramid.levels[0], over, lod, steps), steps, refine);
        };
        const real want = height(st, range);
        bool clear = true;
        for (const real e : {-1e-5L, 1e-5L})
            for (const V2 nudged : {V2{st.x + e, st.y}, V2{st.x, st.y + e}})
                clear = clear && std::abs(height(nudged, range * (1 + e)) - want) < 3e-3L;
        c.add((hard ? "rough, seed " : "hills, seed ") + std::to_string(seed), hard);
        c.data.constants.insert(c.data.constants.end(),
                                {double(hard), double(steps), double(refine), double(static_cast<float>(level))});
        c.in("st", st), c.in("range", range), c.in("lod", lod);
        c.out("height", clear ? want : std::numeric_limits<real>::quiet_NaN());
    }
    return c;
}

/// Curvatures of all sizes, also such that would turn the normal away from the viewer.
inline Cases parallax_normal_cases() {
    Cases c{.name = "parallax normal"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const V n = random.unit();
        const bool hard = seed > 100;
        const real size = hard ? random.magnitude(-12, 1) : random.magnitude(-4, -2);
        const V a = Random::rounded(random.box(size)), b = Random::rounded(random.box(size));
        const V2 pixels{random.uniform(-20, 20), random.uniform(-20, 20)};
        c.add("parallax normal, seed " + std::to_string(seed), hard);
        const V moved = reference::parallax_normal(normalize(n), a, b, pixels, n);
        // Never so close to a right angle that rounding decides.
        const V view = Random::rounded(normalize(moved) * 0.9L + random.unit());
        c.in("n", n), c.in("dn_dx", a), c.in("dn_dy", b), c.in("pixels", pixels), c.in("view", view);
        const V want = reference::parallax_normal(normalize(n), a, b, pixels, view);
        const bool clear = std::abs(dot(normalize(view), normalize(n + a * pixels.x + b * pixels.y))) > 1e-5L;
        c.out("normal", clear ? want : V{} / real{0});
    }
    c.add("parallax normal that would vanish", true);
    c.in("n", V{0, 0, 1}), c.in("dn_dx", V{0, 0, -0.5L}), c.in("dn_dy", V{}), c.in("pixels", V2{2, 0});
    c.in("view", V{0, 0, 1});
    c.out("normal", V{0, 0, 1});
    return c;
}

}  // namespace wrinkle::cases
