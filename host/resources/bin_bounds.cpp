#include "resources/bin_bounds.h"

#include <algorithm>
#include <cmath>

#include "base/imath.h"

namespace wrinkle {

namespace {

using Imath::V3d;

V3d vec(const double (&v)[3]) { return {v[0], v[1], v[2]}; }

/// Six planes of `count` bounds, all of them of nothing.
std::vector<float> no_bounds(std::size_t count) {
    std::vector<float> planes(6 * count, WR_BIN_NOTHING);
    std::fill(planes.begin() + static_cast<std::ptrdiff_t>(3 * count), planes.end(), -WR_BIN_NOTHING);
    return planes;
}

std::size_t sixteens(std::size_t count) { return (count + 15) / 16; }

float narrow(double v) { return static_cast<float>(std::clamp(v, -3e38, 3e38)); }

}  // namespace

BinBounds bin_bounds(const std::vector<wr_projector>& decals, const Camera& camera) {
    BinBounds out;
    const auto row = [&](std::size_t i) { return V3d(camera.view[i][0], camera.view[i][1], camera.view[i][2]); };
    const V3d right = direction(row(0)), back = direction(right.cross(row(1)));
    out.axes = {right, right.cross(back), -back};

    const std::size_t groups = sixteens(decals.size()), padded = 16 * groups, padded_groups = 16 * sixteens(groups);
    out.boxes.resize(WR_BOX_NUMBERS * padded);
    out.bounds = no_bounds(padded);
    out.groups = no_bounds(padded_groups);
    for (std::size_t i = 0; i < decals.size(); ++i) {
        const wr_projector& decal = decals[i];
        const V3d center = vec(decal.center), rows[] = {vec(decal.to_box_x), vec(decal.to_box_y), vec(decal.to_box_z)};
        if (rows[0] == V3d(0)) continue;  // touches nothing
        float* box = out.boxes.data() + WR_BOX_NUMBERS * i;
        for (std::size_t k = 0; k < 3; ++k) {
            const double middle = out.axes[k].dot(center);
            double reach = 0;
            for (std::size_t r = 0; r < 3; ++r) {
                const double along = rows[r].dot(out.axes[k]);
                box[3 + 3 * r + k] = narrow(along);
                reach += std::abs(along) / rows[r].length2();
            }
            reach *= WR_BIN_BOX_SLACK;
            box[k] = narrow(middle);
            box[12 + k] = narrow(reach);
            const float low = narrow(middle - reach), high = narrow(middle + reach);
            out.bounds[k * padded + i] = low;
            out.bounds[(k + 3) * padded + i] = high;
            float &group_low = out.groups[k * padded_groups + i / 16],
                  &group_high = out.groups[(k + 3) * padded_groups + i / 16];
            group_low = std::min(group_low, low);
            group_high = std::max(group_high, high);
        }
        box[15] = static_cast<float>(decal.shape);
    }
    return out;
}

BinBounds bin_bounds(const std::vector<wr_light>& lights, const Camera& camera) {
    constexpr double kEverywhere = 1e30;  // metres: the radius of lights without a range
    std::vector<wr_projector> spheres;
    spheres.reserve(lights.size());
    for (const wr_light& light : lights) {
        wr_projector& sphere = spheres.emplace_back();
        std::ranges::copy(light.position, sphere.center);
        sphere.to_box_x[0] = sphere.to_box_y[1] = sphere.to_box_z[2] =
            light.fade > 0 ? std::max(std::sqrt(light.fade), 1 / kEverywhere) : 1 / kEverywhere;
        sphere.shape = static_cast<double>(ProjectorShape::sphere);
    }
    return bin_bounds(spheres, camera);
}

}  // namespace wrinkle
