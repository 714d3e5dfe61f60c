#pragma once

#include "run/frame_constants.h"
#include "tests/cases/cases.h"
#include "tests/reference/decal.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::cases {

inline void add_decal(Cases& c, const wr_decal& decal) {
    const double* numbers = decal.center;
    c.data.records_per_row = sizeof(wr_decal) / sizeof(double);
    c.data.records.insert(c.data.records.end(), numbers, numbers + c.data.records_per_row);
}

inline void put(double (&to)[3], V v) {
    to[0] = static_cast<double>(v.x), to[1] = static_cast<double>(v.y), to[2] = static_cast<double>(v.z);
}

/// Listing 15: the gradient of slopes d along the projector's axes X and Y, projected onto the surface of normal n.
inline Cases decal_gradient_cases() {
    Cases c{.name = "listing15_decal"};
    const GoldenTable table = reference::golden("listing15_decal");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const V x = table.vec(i, "X"), y = table.vec(i, "Y"), want = table.vec(i, "want_sg");
        const V2 d = table.vec2(i, "d");
        const V g = reference::decal_volume_gradient(d, x, y);
        add_golden_row(c, table, i, {"n"}, std::max(real{1}, length(g) / length(want)));
        c.in("slope", d), c.in("weight", real{1});
        c.out("dh_dp", g), c.out("sg", want);
        wr_decal decal{};
        put(decal.gradient_s, x), put(decal.gradient_t, y);
        const V z = Random::rounded(normalize(cross(x, y)));
        put(decal.axis_z, z), c.out("normal", normalize(z - g));
        add_decal(c, decal);
    }
    return c;
}

/// Points in and around boxes of any orientation and size, with every kind of fade.
inline Cases decal_box_cases() {
    Cases c{.name = "decal boxes"};
    for (unsigned seed = 1; seed <= 400; ++seed) {
        Random random(seed);
        const real size = random.magnitude(-3, 3);
        const V half = Random::rounded(V{1, random.magnitude(-1, 1), random.magnitude(-1, 1)} * size);
        const V center = Random::rounded(random.box(10 * size)), n = random.unit();
        const auto box = reference::decal_box(center, random.unit(), random.unit(), half);
        const V q = random.box(1.2L);
        const V p = Random::rounded(center + box.x * (q.x * half.x) + box.y * (q.y * half.y) + box.z * (q.z * half.z));
        const V dp = Random::rounded(random.box(size / 100));
        const real falloff = seed % 4 == 0 ? 0 : random.uniform(0.05L, 1), a0 = random.uniform(-0.5L, 0.5L);
        const real a1 = seed % 5 == 0 ? a0 : a0 + random.uniform(0.05L, 0.5L);

        wr_decal d{};
        put(d.center, center);
        put(d.to_box_x, box.x / half.x), put(d.to_box_y, box.y / half.y), put(d.to_box_z, box.z / half.z);
        put(d.axis_z, box.z);
        d.falloff = falloff > 0 ? static_cast<double>(1 / falloff) : 0;
        d.fade_zero = static_cast<double>(a0);
        d.fade_slope = 1 / std::max(static_cast<double>(a1 - a0), 1e-6);
        add_decal(c, d);

        const V at = reference::decal_coordinates(box, p - center), step = reference::decal_coordinates(box, dp);
        const real cosine = dot(normalize(n), box.z);
        const bool on_edge = std::abs(largest(at) - 1) < 1e-4L || (a1 == a0 && std::abs(cosine - a0) < 1e-4L);
        if (on_edge) {  // rounding decides on which side: either answer is right
            c.data.records.resize(c.data.records.size() - c.data.records_per_row);
            continue;
        }
        c.add("decal box, seed " + std::to_string(seed), seed % 2 == 0);
        c.in("n", n), c.in("p", p), c.in("dp", dp);
        c.out("q", at), c.out("st", V2{(at.x + 1) / 2, (at.y + 1) / 2}), c.out("step", V2{step.x / 2, step.y / 2});
        c.out("inside", largest(at) <= 1 ? real{1} : real{0});
        c.out("falloff", reference::decal_box_weight(at, falloff));
        c.out("fade", reference::decal_angle_fade(cosine, a0, a1));
    }
    return c;
}

}  // namespace wrinkle::cases
