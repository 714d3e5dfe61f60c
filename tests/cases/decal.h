#pragma once

#include "resources/frame_constants.h"
#include "tests/cases/cases.h"
#include "tests/reference/decal.h"
#include "tests/reference/volume_gradient.h"

namespace wrinkle::cases {

inline void put(double (&to)[3], V v) {
    to[0] = static_cast<double>(v.x), to[1] = static_cast<double>(v.y), to[2] = static_cast<double>(v.z);
}

/// Listing 15: the gradient of slopes d along the projector's axes X and Y, projected onto the surface of normal n.
inline Cases projector_golden_cases() {
    Cases c{.name = "listing15_decal"};
    const GoldenTable table = reference::golden("listing15_decal");
    for (std::size_t i = 0; i < table.size(); ++i) {
        const V x = table.vec(i, "X"), y = table.vec(i, "Y"), want = table.vec(i, "want_sg");
        const V2 d = table.vec2(i, "d");
        const V g = reference::decal_volume_gradient(d, x, y);
        add_golden_row(c, table, i, {"n"}, std::max(real{1}, length(g) / length(want)));
        c.in("p", V{0, 0, 0}), c.in("slope", d), c.in("weight", real{1});
        c.out("dh_dp", g), c.out("sg", want);
        wr_projector decal{};
        put(decal.to_box_x, x), put(decal.to_box_y, y);
        decal.strength[0] = decal.strength[1] = decal.opacity = 1;
        const V z = Random::rounded(normalize(cross(x, y)));
        put(decal.to_box_z, z), c.out("normal", normalize(normalize(z) - g));
        const auto* numbers = reinterpret_cast<const double*>(&decal);
        c.data.records_per_row = sizeof(wr_projector) / sizeof(double);
        c.data.records.insert(c.data.records.end(), numbers, numbers + c.data.records_per_row);
    }
    return c;
}

}  // namespace wrinkle::cases
