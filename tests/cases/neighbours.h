#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/uv_derivative.h"

namespace wrinkle::cases {

using Pixel = reference::UvPixel<real>;

inline void put(Cases& c, const std::string& name, const Pixel& p) {
    c.in(name + "P", p.position), c.in(name + "N", p.normal), c.in(name + "UV", p.uv);
    c.in(name + "_object", real{*p.object}), c.in(name + "_valid", p.valid ? 1 : 0);
}

/// A neighbour of a pixel at the origin with normal (0, 0, 1), about `direction` steps of dp away. With `spoil` 0 to 3
/// it is invalid, of another object, or beyond a break of normals or of depth.
inline Pixel neighbour_on_plane(Random& random, V dp, real direction, int spoil) {
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
}

/// Which neighbour a height is differenced with: the next pixel, else the one before; none across a break.
inline Cases height_neighbour_cases() {
    Cases c{.name = "neighbours of heights"};
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        const V dp = random.box(0.1L);
        const Pixel here{seed % 50 != 0, 3.0f, {0, 0, 1}, {}, {}};
        const Pixel before = neighbour_on_plane(random, dp, -1, random.below(8));
        const Pixel after = neighbour_on_plane(random, dp, 1, random.below(8));
        const real size = random.magnitude(-6, 6), h = random.uniform(-1, 1) * size;
        const auto height = [&](int spoil) {
            return spoil == 0 ? std::numeric_limits<real>::quiet_NaN()
                              : real{static_cast<float>(random.uniform(-1, 1) * size)};
        };
        const real mine = static_cast<float>(h), left = height(random.below(10)), right = height(random.below(10));
        const auto want = here.valid ? height_difference(here, before, after, mine, left, right, dp) : std::nullopt;
        c.add("neighbours of heights, seed " + std::to_string(seed), seed % 2 == 0, size);
        c.in("dp", dp), c.in("here_valid", here.valid ? 1 : 0);
        put(c, "before", before), put(c, "after", after);
        c.in("before_height", left), c.in("after_height", right), c.in("here_height", mine);
        c.out("difference", want.value_or(0)), c.out("usable", want ? real{1} : real{0});
    }
    return c;
}

/// Which neighbours a normal is differenced with: both, one, or none. Normals have any length that is not taken for
/// noise.
inline Cases normal_neighbour_cases() {
    Cases c{.name = "neighbours of normals"};
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        const V dp = random.box(0.1L);
        const Pixel here{seed % 50 != 0, 3.0f, {0, 0, 1}, {}, {}};
        Pixel before = neighbour_on_plane(random, dp, -1, random.below(8));
        Pixel after = neighbour_on_plane(random, dp, 1, random.below(8));
        c.add("neighbours of normals, seed " + std::to_string(seed), seed % 2 == 0);
        c.in("dp", dp), c.in("here_valid", here.valid ? 1 : 0);
        for (const auto& [name, p] : {std::pair{"before", &before}, {"after", &after}}) {
            Pixel longer = *p;
            longer.normal = Random::rounded(p->normal * (seed % 2 ? real{1} : random.magnitude(-18, 18)));
            put(c, name, longer);
            p->normal = normalize(longer.normal);
        }
        c.out("difference", here.valid ? normal_difference(here, before, after, dp) : V{});
    }
    return c;
}

/// The rule for texture coordinates, with all combinations of usable, broken and unequal neighbours.
inline Cases neighbour_cases() {
    Cases c{.name = "neighbours"};
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        const V dp = random.box(0.1L);
        const V2 rate{random.uniform(-0.1L, 0.1L), random.uniform(-0.1L, 0.1L)};
        const auto make = [&](real direction, bool spoil, real fold) {
            const real stretch = random.uniform(0.5L, 1.5L);
            Pixel p{true, 3.0f, random.unit(), dp * (direction * stretch),
                    V2{0.5L, 0.5L} + rate * (fold * direction * random.uniform(0.4L, 2.2L))};
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
        const real fold = seed % 11 == 0 ? 0 : seed % 7 == 0 ? -1 : 1;  // -1: a seam mirrors the coordinates
        const Pixel before = make(-1, random.below(3) == 0, 1), after = make(1, random.below(3) == 0, fold);
        auto [forward, backward] = uv_differences(here, before, after, dp);
        if (!here.valid) backward = forward = std::nullopt;
        const auto want = combine_differences(forward, backward);
        c.add("neighbours, seed " + std::to_string(seed), seed % 2 == 0);
        c.in("dp", dp), c.in("here_valid", here.valid ? 1 : 0);
        put(c, "before", before), put(c, "after", after);
        const reference::UvChange<real> none{};
        c.out("difference", want.value_or(none).uv), c.out("step", want.value_or(none).step);
        c.out("usable", want ? real{1} : real{0});
    }
    return c;
}

/// Changes of texture coordinates along steps to neighbours on curved surfaces. Steps are shorter than dp, turned, or
/// lead out of the tangent plane; the two steps are at right angles, or nearly parallel, as on surfaces seen edge on.
inline Cases texcoord_changes_cases() {
    Cases c{.name = "derivatives from changes"};
    using Change = reference::UvChange<real>;
    for (unsigned seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0, kept = seed % 20 == 0;
        const real size = hard ? random.magnitude(-6, 3) : 0.01L;
        const V x = random.unit(), y = normalize(cross(random.unit(), x));
        const real cosine = hard ? random.uniform(-0.98L, 0.98L) : 0;
        const V dp_dx = Random::rounded(x * size);
        const V dp_dy = Random::rounded((x * cosine + y * std::sqrt(1 - cosine * cosine)) * size *
                                        (hard ? random.magnitude(-1, 1) : 1));
        const V out = cross(x, y) * size * (hard ? real{2} : 0.1L);
        const auto change = [&](V dp, V other) {
            const real part = random.uniform(hard ? 0.05L : 0.7L, 1.2L);
            const V step = dp * part + other * random.uniform(-0.1L, 0.1L) * part + out * random.uniform(-1, 1);
            const V2 uv{random.uniform(-0.1L, 0.1L), random.uniform(-0.1L, 0.1L)};
            return Change{{static_cast<float>(uv.x), static_cast<float>(uv.y)}, Random::rounded(step)};
        };
        Change to_x = change(dp_dx, dp_dy), to_y = change(dp_dy, dp_dx);
        if (kept) to_y.step = Random::rounded(to_x.step * real{2});  // parallel: the changes are returned as they are
        const auto [dx, dy] = reference::uv_derivatives(to_x, to_y, dp_dx, dp_dy);
        // Each derivative is a sum of both changes. The shorter and the more skewed the steps, the larger its factors.
        const V normal = normalize(cross(dp_dx, dp_dy));
        const real first = length(to_x.step), second = length(to_y.step);
        const real area = std::abs(dot(normal, cross(to_x.step, to_y.step)));
        const real terms = (std::hypot(to_x.uv.x, to_x.uv.y) * second + std::hypot(to_y.uv.x, to_y.uv.y) * first) *
                           std::max(length(dp_dx), length(dp_dy)) / area;
        c.add("derivatives from changes, seed " + std::to_string(seed), hard,
              kept ? real{1} : terms * (1 + first * second / area) / (1 - cosine * cosine));
        c.in("dp_dx", dp_dx), c.in("dp_dy", dp_dy), c.in("step_x", to_x.step), c.in("step_y", to_y.step);
        c.in("change_x", to_x.uv), c.in("change_y", to_y.uv);
        c.out("dst_dx", dx), c.out("dst_dy", dy);
    }
    return c;
}

}  // namespace wrinkle::cases
