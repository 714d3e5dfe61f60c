#pragma once

#include "tests/cases/cases.h"
#include "tests/reference/uv_derivative.h"

namespace wrinkle::cases {

/// Least squares of dp = a dp_du + b dp_dv, for tangents of any scale, skew and handedness, and dp within and out of
/// their plane.
inline Cases texcoord_step_cases() {
    Cases c{.name = "steps from tangents"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const real u = hard ? random.magnitude(-15, 15) : 1, v = hard ? u * random.magnitude(-3, 3) : 1;
        const V dp_du = Random::rounded(random.unit() * u), dp_dv = Random::rounded(random.unit() * v);
        const V off = normalize(cross(dp_du, dp_dv)) * random.uniform(-1, 1) * (u / 10);
        const V dp = Random::rounded(dp_du * random.uniform(-1, 1) + dp_dv * random.uniform(-1, 1) + off);
        // Digits are lost to tangents that are nearly parallel, and to the part of dp that is out of their plane.
        const real skew = 1 / length(cross(normalize(dp_du), normalize(dp_dv)));
        const auto want = reference::uv_derivative_from_tangents(dp, dp_du, dp_dv);
        const real terms = length(dp) * (length(dp_du) + length(dp_dv)) * skew * skew / (length(dp_du) * length(dp_dv));
        c.add("step from tangents, seed " + std::to_string(seed), hard,
              std::max(real{1}, terms / std::hypot(want->x, want->y)));
        c.in("dp", dp), c.in("dp_du", dp_du), c.in("dp_dv", dp_dv);
        c.out("step", *want), c.out("usable", real{1});
    }
    for (const V dp_dv : {V{}, V{2, 4, 6}, V{-1, -2, -3}}) {  // parallel tangents: 0, and "usable" is 0
        c.add("step from parallel tangents", true);
        c.in("dp", V{1, 1, 1}), c.in("dp_du", V{1, 2, 3}), c.in("dp_dv", dp_dv);
        c.out("step", V2{}), c.out("usable", real{0});
    }
    return c;
}

/// Planar projections of any tiling and translation. Errors are judged by the size of the terms that are summed.
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

}  // namespace wrinkle::cases
