#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/uv_derivative.h"

namespace wrinkle::cases {

/// Least squares of dp = a dp_du + b dp_dv for tangents of any scale, skew and handedness, dp in and out of their
/// plane.
inline Cases texcoord_step_cases() {
    Cases c{.name = "steps from tangents"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const real u = hard ? random.magnitude(-15, 15) : 1, v = hard ? u * random.magnitude(-3, 3) : 1;
        const V dp_du = Random::rounded(random.unit() * u), dp_dv = Random::rounded(random.unit() * v);
        const V off = normalize(cross(dp_du, dp_dv)) * random.uniform(-1, 1) * (u / 10);
        const V dp = Random::rounded(dp_du * random.uniform(-1, 1) + dp_dv * random.uniform(-1, 1) + off);
        // Nearly parallel tangents and what is out of their plane take their share of the digits.
        const real skew = 1 / length(cross(normalize(dp_du), normalize(dp_dv)));
        const auto want = reference::uv_derivative_from_tangents(dp, dp_du, dp_dv);
        const real terms = length(dp) * (length(dp_du) + length(dp_dv)) * skew * skew / (length(dp_du) * length(dp_dv));
        c.add("step from tangents, seed " + std::to_string(seed), hard,
              std::max(real{1}, terms / std::hypot(want->x, want->y)));
        c.in("dp", dp), c.in("dp_du", dp_du), c.in("dp_dv", dp_dv);
        c.out("step", *want), c.out("usable", real{1});
    }
    for (const V dp_dv : {V{}, V{2, 4, 6}, V{-1, -2, -3}}) {  // no answer: 0, and the pixel is not usable
        c.add("step from parallel tangents", true);
        c.in("dp", V{1, 1, 1}), c.in("dp_du", V{1, 2, 3}), c.in("dp_dv", dp_dv);
        c.out("step", V2{}), c.out("usable", real{0});
    }
    return c;
}

/// Planar projections of any tiling and translation; errors are to the size of what is summed.
inline Cases planar_cases() {
    Cases c{.name = "planar texture coordinates"};
    c.data.constants_per_row = 8;
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const real tiling = hard ? random.magnitude(-5, 5) : random.uniform(0.5L, 2);
        const real far = hard ? random.magnitude(-3, 4) : random.uniform(1, 10),
                   pixel = hard ? random.magnitude(-9, 0) : 0.01L;
        const V s = Random::rounded(random.unit() * tiling), t = Random::rounded(random.unit() * tiling);
        const V2 offset{random.uniform(-1, 1) * tiling, random.uniform(-1, 1) * tiling};
        const V2 o{static_cast<float>(offset.x), static_cast<float>(offset.y)};
        const V p = Random::rounded(random.unit() * far), dx = Random::rounded(random.unit() * pixel),
                dy = Random::rounded(random.unit() * pixel);
        c.add("planar, seed " + std::to_string(seed), hard,
              std::max(real{1}, tiling * std::max({far + 1, pixel, real{0}})));
        for (const real v : {s.x, s.y, s.z, t.x, t.y, t.z, o.x, o.y})
            c.data.constants.push_back(static_cast<double>(v));
        c.in("p", p), c.in("dp_dx", dx), c.in("dp_dy", dy);
        c.out("st", V2{dot(s, p) + o.x, dot(t, p) + o.y});
        c.out("dst_dx", V2{dot(s, dx), dot(t, dx)}), c.out("dst_dy", V2{dot(s, dy), dot(t, dy)});
    }
    return c;
}

/// The rule for heights: the next pixel, else the one before; none across a break.
inline Cases height_neighbour_cases() {
    Cases c{.name = "neighbours of heights"};
    using Pixel = reference::UvPixel<real>;
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        const V dp = random.box(0.1L);
        const auto make = [&](real direction, int spoil) {
            Pixel p{true,
                    3.0f,
                    Random::rounded(normalize(V{0, 0, 1} + random.unit() * 0.3L)),
                    Random::rounded(dp * (direction * random.uniform(0.5L, 1.5L))),
                    {}};
            if (spoil == 0) p.valid = false;
            if (spoil == 1) p.object = 4.0f;
            if (spoil == 2) p.normal = {1, 0, 0};
            if (spoil == 3) p.position = Random::rounded(dp * (direction * 5));
            return p;
        };
        const Pixel here{seed % 50 != 0, 3.0f, {0, 0, 1}, {}, {}};
        const Pixel before = make(-1, random.below(8)), after = make(1, random.below(8));
        const real size = random.magnitude(-6, 6), h = random.uniform(-1, 1) * size;
        const auto height = [&](int spoil) {
            return spoil == 0 ? std::numeric_limits<real>::quiet_NaN()
                              : real{static_cast<float>(random.uniform(-1, 1) * size)};
        };
        const real mine = static_cast<float>(h), left = height(random.below(10)), right = height(random.below(10));
        const auto want = here.valid ? height_difference(here, before, after, mine, left, right, dp) : std::nullopt;
        c.add("neighbours of heights, seed " + std::to_string(seed), seed % 2 == 0, size);
        c.in("dp", dp), c.in("here_valid", here.valid ? 1 : 0);
        const auto put = [&](const std::string& name, const Pixel& p, real value) {
            c.in(name + "P", p.position), c.in(name + "N", p.normal), c.in(name + "_height", value);
            c.in(name + "_object", real{*p.object}), c.in(name + "_valid", p.valid ? 1 : 0);
        };
        put("before", before, left), put("after", after, right), c.in("here_height", mine);
        c.out("difference", want.value_or(0)), c.out("usable", want ? real{1} : real{0});
    }
    return c;
}

/// The neighbour rule: combinations of usable, broken and unequal neighbours.
inline Cases neighbour_cases() {
    Cases c{.name = "neighbours"};
    using Pixel = reference::UvPixel<real>;
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        const V dp = random.box(0.1L);
        const V2 rate{random.uniform(-0.1L, 0.1L), random.uniform(-0.1L, 0.1L)};
        const auto make = [&](real direction, bool spoil) {
            const real stretch = random.uniform(0.5L, 1.5L);
            Pixel p{true, 3.0f, random.unit(), dp * (direction * stretch),
                    V2{0.5L, 0.5L} + rate * (direction * random.uniform(0.4L, 2.2L))};
            p.normal = Random::rounded(normalize(V{0, 0, 1} + p.normal * 0.3L));
            switch (spoil ? random.below(6) : 6) {
                case 0:
                    p.valid = false;
                    break;
                case 1:
                    p.object = 4.0f;
                    break;
                case 2:
                    p.normal = {1, 0, 0};
                    break;
                case 3:
                    p.position = dp * (direction * 5);
                    break;
                case 4:
                    p.uv.x += 0.9L;
                    break;
                case 5:
                    p.uv.y -= 0.8L;
                    break;
                default:
                    break;
            }
            p.position = Random::rounded(p.position);
            p.uv = {static_cast<float>(p.uv.x), static_cast<float>(p.uv.y)};
            return p;
        };
        const Pixel here{seed % 50 != 0, 3.0f, {0, 0, 1}, {}, {0.5L, 0.5L}};
        const Pixel before = make(-1, random.below(3) == 0), after = make(1, random.below(3) == 0);
        auto backward = uv_difference(here, before, dp), forward = uv_difference(here, after, dp);
        if (!here.valid) backward = forward = std::nullopt;
        if (backward) backward = *backward * real{-1};
        const auto want = combine_differences(forward, backward);
        c.add("neighbours, seed " + std::to_string(seed), seed % 2 == 0);
        c.in("dp", dp), c.in("here_valid", here.valid ? 1 : 0);
        const auto put = [&](const std::string& name, const Pixel& p) {
            c.in(name + "P", p.position), c.in(name + "N", p.normal), c.in(name + "UV", p.uv);
            c.in(name + "_object", real{*p.object}), c.in(name + "_valid", p.valid ? 1 : 0);
        };
        put("before", before), put("after", after);
        c.out("difference", want.value_or(V2{})), c.out("usable", want ? real{1} : real{0});
    }
    return c;
}

}  // namespace wrinkle::cases
