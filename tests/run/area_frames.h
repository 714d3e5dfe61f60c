#pragma once

#include "tests/run/run_frame.h"

namespace wrinkle::test {

inline constexpr Size kSize{24, 16};

/// At (0, -6, 1.2), looking at the ground near the origin: it fills the frame up to a horizon.
inline Camera low_camera() {
    const V eye{0, -6, 1.2}, back = normalize(eye - V{0, 0, 0.3}), right{1, 0, 0}, up = cross(back, right);
    const auto row = [&](V a) { return std::array<double, 4>{a.x, a.y, a.z, -dot(a, eye)}; };
    return {{row(right), row(up), row(back), {0, 0, 0, 1}},
            {{{1.9, 0, 0, 0}, {0, 2.7, 0, 0}, {0, 0, -1.002, -0.2002}, {0, 0, -1, 0}}}};
}

inline HostFrame ground(Size size) {
    HostFrame frame(plane_frame(low_camera(), size, {0, 0, 1}), low_camera());
    frame.remove("position.x"), frame.remove("position.y"), frame.remove("position.z");
    for (float& depth : frame.pixels["depth"])
        if (!(depth > 0 && depth < 60)) depth = 1e10f;
    return frame;
}

inline Scene scene_of(Layer layer, int taps = 16) {
    Scene scene;
    layer.name = "bump";
    scene.layers = {std::move(layer)};
    scene.output = {.slope_covariance = true, .surface_gradient = true};
    scene.filter.taps = taps;
    return scene;
}

template <class Bump>
Layer layer_of(Bump bump, double scale) {
    Layer layer;
    layer.bump = std::move(bump), layer.scale = scale;
    return layer;
}

inline const fs::path cobbles = data_folder / "textures/cobbles_height.png",
                      weave = data_folder / "textures/weave_normal.png";
inline const UvMapping planar{.source = UvSource::planar, .scale = {0.08, 0.08}};

}  // namespace wrinkle::test
