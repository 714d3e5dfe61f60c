#pragma once

#include "tests/cases/surface_derivatives.h"
#include "tests/reference/texture_metres.h"

namespace wrinkle::cases {

/// Metres of surface for a unit of texture coordinate, for any footprint and skew; 0 where one of the two has no area.
inline Cases texture_metres_cases() {
    Cases c{.name = "texture metres"};
    const auto answer = [&](const SurfaceDerivatives& d) {
        c.in("dp_dx", d.dp_dx), c.in("dp_dy", d.dp_dy), c.in("dst_dx", d.st.dx), c.in("dst_dy", d.st.dy);
        c.out("metres", reference::texture_metres(d.dp_dx, d.dp_dy, d.st));
    };
    const GoldenTable table = reference::golden("listing06_scale_dependent");
    for (std::size_t i = 0; i < table.size(); ++i) {
        add_golden_row(c, table, i, {});
        answer(golden_derivatives(table, i));
    }
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        c.add("texture metres, any footprint, seed " + std::to_string(seed), true);
        answer(random_derivatives(random));
    }
    for (unsigned seed = 1; seed <= 40; ++seed) {  // the footprint is a line, in space or in the texture
        Random random(seed);
        SurfaceDerivatives d = random_derivatives(random);
        if (seed % 2)
            d.dp_dy = d.dp_dx * real(2);
        else
            d.st.dy = d.st.dx * real(-4);
        c.add("texture metres, degenerate, seed " + std::to_string(seed), true);
        answer(d);
        c.want["metres"].back() = V{};
    }
    return c;
}

}  // namespace wrinkle::cases
