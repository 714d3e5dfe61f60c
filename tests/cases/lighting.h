#pragma once

#include "resources/frame_constants.h"
#include "tests/cases/cases.h"
#include "tests/reference/lighting.h"

namespace wrinkle::cases {

constexpr double lighting_relative = 2e-6, smooth_lighting_relative = 1e-4;

inline Lighting test_lighting() {
    Lighting lighting;
    lighting.ambient = {0.125, 0.25, 0.5};
    lighting.f0 = 0.0625;
    lighting.lights = {{LightKind::sun, {1, 0.5, 0.25}, 2, {}, {0, 0, -1}, 0, 0},
                       {LightKind::point, {0.5, 1, 1}, 8, {2, -1, 3}, {0, 0, -1}, 0, 0},
                       {LightKind::spot, {1, 1, 0.5}, 16, {-2, 1, 4}, {0, 0, -1}, 0.25, 0.75}};
    lighting.lights[1].picture = "lamp", lighting.lights[2].specular = "gleam";
    lighting.lights[2].range = 40;
    Light sky{.kind = LightKind::sky};
    sky.intensity = 0.5, sky.up = {0.36, -0.48, 0.8};
    sky.zenith = {0.25, 0.5, 1}, sky.horizon = {0.75, 0.75, 0.5}, sky.ground = {0.25, 0.125, 0};
    lighting.lights.push_back(sky);
    return lighting;
}

/// A surface under a sun, a point and a spot light, with its own normal n and with another normal m. The constants are
/// one wr_lighting and its lights. Regular: rough surfaces. Hard: highlights of smooth ones, grazing views, surfaces at
/// a light's position and surfaces that face away from all lights.
inline Cases lighting_cases() {
    Cases c{.name = "lighting"};
    const Lighting lighting = test_lighting();
    const Camera at_origin{{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}},
                           {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, -0.5}, {0, 0, -1, 0}}}};
    Scene scene;
    scene.lighting = lighting;
    const FrameConstants constants = frame_constants({}, {scene, {}}, at_origin, {8, 8});
    const double *first = constants.lighting.sky, *light = &constants.lights[0].kind;
    c.data.constants.assign(first, first + sizeof(wr_lighting) / sizeof(double));
    c.data.constants.insert(c.data.constants.end(), light,
                            light + constants.lights.size() * sizeof(wr_light) / sizeof(double));
    for (unsigned seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V p = hard && seed % 10 == 0 ? Random::rounded(V{2, -1, 3} + random.unit() * random.magnitude(-6, 0))
                                           : random.box(4);
        V v = random.unit(), n = random.unit();
        if (hard && seed % 3 == 0)  // at or near the sun's mirror direction
            n = Random::rounded(normalize(normalize(v + V{0, 0, 1}) + random.unit() * random.magnitude(-5, -1)));
        if (hard && seed % 3 == 1) v = Random::rounded(normalize(cross(n, v) + n * random.magnitude(-7, -2)));
        const reference::Surface<real> surface{
            {0.5L, 0.25L, 0.75L}, hard ? random.uniform(0, 0.3L) : random.uniform(0.3L, 1), 0.0625L};
        c.add("lighting, seed " + std::to_string(seed), hard);
        c.in("p", p), c.in("n", n), c.in("v", v), c.in("roughness", surface.roughness);
        V m = hard ? random.unit() : Random::rounded(normalize(n + random.unit() * 0.5L));
        if (dot(m, v) < 0) m = m * -1.0L;  // the surface that carries the bumps faces the viewer
        c.in("m", m);
        c.out("lit", reference::lit(lighting, normalize(n), normalize(m), normalize(v), p, surface));
        const V bare = normalize(m), view = normalize(v);
        c.out("lamp", reference::lit_by("lamp", lighting, normalize(n), bare, view, p, surface));
        c.out("base", reference::lit_by("lamp", lighting, bare, bare, view, p, surface));
        c.out("gleam", reference::lit_by("gleam", lighting, normalize(n), bare, view, p, surface));
        c.out("rest", reference::lit_by("", lighting, normalize(n), bare, view, p, surface));
        c.out("sky", reference::sky_light(lighting, normalize(n), bare));
    }
    return c;
}

/// A bumped normal n, the base's m and a light's direction p. Hard: lights near both terminators, and bumps that face
/// away from their base.
inline Cases terminator_cases() {
    Cases c{.name = "terminator"};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V m = random.unit(), n = hard ? random.unit() : Random::rounded(normalize(m + random.unit() * 0.7L));
        V l = random.unit();
        if (hard) l = Random::rounded(normalize(cross(m, l) + m * random.magnitude(-6, -1)));
        if (!hard && std::abs(dot(normalize(n), normalize(l))) < 0.05L) l = m;
        c.add("terminator, seed " + std::to_string(seed), hard);
        c.in("n", n), c.in("m", m), c.in("p", l);
        c.out("keeps", reference::terminator(normalize(n), normalize(m), normalize(l)));
    }
    return c;
}

/// A bumped normal n, the base's m and the view v, which are less than a right angle apart. Hard: views along the base.
inline Cases mirror_cases() {
    Cases c{.name = "mirror normal"};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const bool hard = seed % 2 == 0;
        const V m = random.unit();
        V v = random.unit(), n = Random::rounded(normalize(m + random.unit() * (hard ? 2.0L : 0.9L)));
        if (hard) v = Random::rounded(normalize(cross(m, v) + m * random.magnitude(-4, -1)));
        if (dot(m, v) < 0) v = v * -1.0L;
        c.add("mirror normal, seed " + std::to_string(seed), hard);
        c.in("n", n), c.in("m", m), c.in("v", v);
        c.out("mirror", reference::mirror_normal(normalize(n), normalize(m), normalize(v)));
    }
    return c;
}

}  // namespace wrinkle::cases
