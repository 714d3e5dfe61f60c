#pragma once

#include "tests/cases/surface_derivatives.h"
#include "tests/reference/displacement.h"

namespace wrinkle::cases {

/// Points near and far, with gradients from tangent to the surface to nearly along its normal.
inline Cases displace_cases() {
    Cases c{.name = "displace"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const bool hard = seed > 100;
        const V n = random.unit(), p = Random::rounded(random.box(hard ? random.magnitude(-6, 6) : 10));
        const V g = Random::rounded(hard ? (n + random.unit() * random.magnitude(-6, 1)) * random.magnitude(-20, 18)
                                         : random.box(2));
        const real h = hard ? random.uniform(-1, 1) * random.magnitude(-20, 6) : random.uniform(-1, 1);
        c.add("displace, seed " + std::to_string(seed), hard);
        c.in("p", p), c.in("n", n), c.in("h", h), c.in("dh_dp", g);
        c.out("displaced", reference::displaced_point(p, n, real{static_cast<float>(h)}));
        c.out("normal", reference::displaced_normal(n, g));
    }
    return c;
}

/// Any footprint, curvature and height; also footprints without an area.
inline Cases displace_curved_cases() {
    Cases c{.name = "displace curved"};
    for (unsigned seed = 1; seed <= 420; ++seed) {
        Random random(seed);
        const bool hard = seed > 100;
        SurfaceDerivatives d = random_derivatives(random);
        if (!hard) {
            const V u = Random::rounded(normalize(cross(d.n, random.unit()))), v = Random::rounded(cross(d.n, u));
            d.dp_dx = Random::rounded(u * 0.01L), d.dp_dy = Random::rounded((v + u * random.uniform(-1, 1)) * 0.02L);
        }
        if (seed > 400) d.dp_dx = d.dp_dy = V{};
        const real curvature = hard ? random.magnitude(-4, 1) : 0.5L;
        const real h = static_cast<float>(random.uniform(-1, 1) * (hard ? random.magnitude(-6, 0) : 0.1L));
        const real slope = hard ? random.magnitude(-3, 2) : 1;
        const V dn_dx = Random::rounded(d.dp_dx * curvature + d.dp_dy * (curvature * 0.1L));
        const V dn_dy = Random::rounded(d.dp_dy * (curvature * random.uniform(-1, 1)));
        const real dh_dx = static_cast<float>(length(d.dp_dx) * slope * random.uniform(-1, 1));
        const real dh_dy = static_cast<float>(length(d.dp_dy) * slope * random.uniform(-1, 1));
        const V p = Random::rounded(random.box(10)), n = normalize(d.n);
        c.add("displace curved, seed " + std::to_string(seed), hard);
        c.in("p", p), c.in("n", d.n), c.in("dp_dx", d.dp_dx), c.in("dp_dy", d.dp_dy);
        c.in("dn_dx", dn_dx), c.in("dn_dy", dn_dy), c.in("h", h), c.in("dh_dx", dh_dx), c.in("dh_dy", dh_dy);
        c.out("displaced", reference::displaced_point(p, n, h));
        c.out("normal", reference::displaced_normal_curved(n, d.dp_dx, d.dp_dy, dn_dx, dn_dy, h, dh_dx, dh_dy));
    }
    return c;
}

}  // namespace wrinkle::cases
