#pragma once

#include "resources/frame_constants.h"
#include "tests/cases/cases.h"
#include "tests/reference/projector.h"

namespace wrinkle::cases {

/// A row of a table as the struct that kernels read, for an image of heights and an eye at the origin.
inline wr_projector projector_record(const Projector& row, const reference::DecalBox<real>& box) {
    wr_projector out{};
    const auto put = [](double(&to)[3], V v) {
        to[0] = static_cast<double>(v.x), to[1] = static_cast<double>(v.y), to[2] = static_cast<double>(v.z);
    };
    put(out.center, box.center);
    put(out.to_box_x, box.x / box.half_size.x);
    put(out.to_box_y, box.y / box.half_size.y);
    put(out.to_box_z, box.z / box.half_size.z);
    for (std::size_t k = 0; k < 2; ++k) out.strength[k] = row.scale / 2, out.repeat[k] = 1;
    for (std::size_t k = 0; k < 3; ++k) out.falloff[k] = row.falloff[k] > 0 ? 1 / row.falloff[k] : 0;
    const double slope = 1 / std::max(row.angle_fade[1] - row.angle_fade[0], 1e-6);
    out.fade_slope = slope * static_cast<double>(box.half_size.z);
    out.fade_zero = slope * row.angle_fade[0];
    out.two_sided = row.two_sided ? 1 : 0;
    out.shape = static_cast<double>(row.shape);
    out.per_size = row.shape == ProjectorShape::cone ? 1 : 0;
    out.opacity = 1;
    return out;
}

/// Points in and around boxes, ellipsoids and cones of any orientation and size, with every kind of fade. Near a cone's
/// apex its image is small, which magnifies errors of coordinates by the square of that.
inline Cases projector_cases() {
    Cases c{.name = "projectors"};
    c.data.records_per_row = sizeof(wr_projector) / sizeof(double);
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        Projector row;
        row.shape = static_cast<ProjectorShape>(seed % 3);
        const real size = random.magnitude(-3, 3);
        const V half = Random::rounded(V{1, random.magnitude(-1, 1), random.magnitude(-1, 1)} * size);
        const auto box =
            reference::decal_box(Random::rounded(random.box(10 * size)), random.unit(), random.unit(), half);
        for (std::size_t k = 0; k < 3; ++k)
            row.falloff[k] = seed % 4 == 0 ? 0 : static_cast<double>(random.uniform(0.05L, 1));
        const real a0 = random.uniform(-0.5L, 0.5L), a1 = seed % 5 == 0 ? a0 : a0 + random.uniform(0.05L, 0.5L);
        row.angle_fade = {static_cast<double>(a0), static_cast<double>(a1)};
        row.two_sided = seed % 2 == 0;
        row.scale = static_cast<double>(random.magnitude(-2, 2));

        V q = random.box(1.2L);
        const bool cone = row.shape == ProjectorShape::cone;
        if (cone) q.x *= (1 - q.z) / 2, q.y *= (1 - q.z) / 2;
        const V p =
            Random::rounded(box.center + box.x * (q.x * half.x) + box.y * (q.y * half.y) + box.z * (q.z * half.z));
        q = reference::decal_coordinates(box, p - box.center);
        const real near = 1.0L / 64, shrunk = cone ? std::max((1 - q.z) / 2, near) : real{1};
        const V2 image{q.x / shrunk, q.y / shrunk};
        const real border = row.shape == ProjectorShape::sphere ? length(q)
                            : cone                              ? std::hypot(image.x, image.y)
                                                                : largest(q);
        const V n = random.unit();
        const real cosine = dot(normalize(n), box.z);
        const bool on_edge = std::abs(border - 1) < 1e-3L / (shrunk * shrunk) || std::abs(largest(q) - 1) < 1e-3L ||
                             (cone && std::abs((1 - q.z) / 2 - near) < 1e-3L) || std::abs(cosine) < 1e-4L ||
                             (a0 == a1 && (std::abs(cosine - a0) < 1e-4L || std::abs(cosine + a0) < 1e-4L));
        if (on_edge) continue;  // rounding decides on which side: either answer is right

        c.add("projector, seed " + std::to_string(seed), seed % 2 == 0, 1 / (shrunk * shrunk));
        const wr_projector record = projector_record(row, box);
        const auto* numbers = reinterpret_cast<const double*>(&record);
        c.data.records.insert(c.data.records.end(), numbers, numbers + c.data.records_per_row);
        const V dp = Random::rounded(random.box(size / 100));
        const V2 slope{random.uniform(-1, 1), random.uniform(-1, 1)};
        const real weight = random.uniform(0.1L, 1);
        c.in("n", n), c.in("p", p), c.in("dp", dp), c.in("slope", slope), c.in("weight", weight);
        const auto at = reference::project(row, box, p);
        Projector hard = row;
        hard.falloff = {0, 0, 0};
        c.out("q", q), c.out("image", image), c.out("size", shrunk);
        c.out("inside", reference::project(hard, box, p).weight);
        c.out("falloff", at.weight);
        const real facing = row.two_sided ? std::abs(cosine) : cosine;
        c.out("fade", facing > 0 ? reference::decal_angle_fade(facing, a0, a1) : real{0});
        const auto step = [&](V direction) { return reference::projected_step(row, box, p, direction); };
        const bool beyond = cone && (1 - q.z) / 2 < near;  // so near the apex that there is no image
        c.out("step", beyond ? V2{NAN, NAN} : step(dp));
        const auto along = [&](V axis) {
            const V2 d = step(axis);
            return weight * real{row.scale} * (slope.x * d.x + slope.y * d.y);
        };
        c.out("dh_dp", beyond ? V{NAN, NAN, NAN} : V{along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})});
    }
    return c;
}

}  // namespace wrinkle::cases
