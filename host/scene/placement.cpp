#include "scene/placement.h"

#include <cmath>

namespace wrinkle {

std::array<Vec3, 3> object_axes(const Placement& placement) {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (std::size_t about = 0; about < 3; ++about) {
        if (placement.rotate[about] == 0) continue;
        const double c = std::cos(placement.rotate[about]), s = std::sin(placement.rotate[about]);
        const std::size_t a = (about + 1) % 3, b = (about + 2) % 3;
        for (Vec3& axis : axes) {
            const double along_a = axis[a], along_b = axis[b];
            axis[a] = c * along_a - s * along_b, axis[b] = s * along_a + c * along_b;
        }
    }
    return axes;
}

std::array<Vec3, 3> normals_to_world(const Placement& placement) {
    const auto axes = object_axes(placement);
    std::array<Vec3, 3> rows{};
    for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t k = 0; k < 3; ++k) rows[j][k] = axes[k][j] / placement.scale[k];
    return rows;
}

namespace scene {

void read_placement(Table& table, Placement& out) {
    table.read("translate", out.translate);
    table.read_degrees("rotate", out.rotate);
    if (table.has("scale") && !table.is_array("scale")) {
        double all = 1;
        if (table.read("scale", all)) out.scale = {all, all, all};
    } else {
        table.read("scale", out.scale);
    }
    for (const double factor : out.scale)
        if (std::abs(factor) < 1e-6 || std::abs(factor) > 1e6) {
            table.complain("scale", "must be from 1e-6 to 1e6 in size (negative mirrors)");
            break;
        }
    table.finish();
}

}  // namespace scene

}  // namespace wrinkle
