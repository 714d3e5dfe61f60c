#pragma once

#include "tests/run/decal_frames.h"

/// Tables of random lights on frames.
namespace wrinkle::test {

/// Points and spots near some of a frame's surfaces, with ranges from `low` to `high` metres; of every seventh light
/// without `all_ranged` none.
inline std::vector<Light> lights_around(const std::vector<std::optional<V>>& points, std::size_t count, double low,
                                        double high, unsigned seed, bool all_ranged = true) {
    Random random(seed);
    std::vector<Light> lights;
    while (lights.size() < count) {
        const auto& p = points[random.engine() % points.size()];
        if (!p) continue;
        Light light{.kind = random.engine() % 3 == 0 ? LightKind::spot : LightKind::point};
        const double range = low * std::pow(high / low, random.in(0, 1));
        const Vec3 off = random.box(0.7 * range);
        light.position = {p->x + off[0], p->y + off[1], p->z + off[2]};
        light.color = {random.in(0.2, 1), random.in(0.2, 1), random.in(0.2, 1)};
        light.intensity = range * range;
        light.direction = random.box(1);
        light.inner_angle = 0.5, light.outer_angle = 1.2;
        if (all_ranged || lights.size() % 7 != 0) light.range = range;
        lights.push_back(light);
    }
    return lights;
}

/// A scene of a bump under such lights alone, with one point a pixel.
inline Scene lit_scene(std::vector<Light> table) {
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "bump";
    scene.layers[0].bump = ConstantLayer{{0.3, -0.1, 0.2}};
    scene.lighting.relight = Relight::lit;
    scene.lighting.table = std::make_shared<const std::vector<Light>>(std::move(table));
    scene.filter.taps = 1;
    return scene;
}

/// A tilted surface lit by lights of the scene, without a table.
inline Scene scene_lit_by(std::vector<Light> lights) {
    Scene scene = lit_scene({});
    scene.lighting.table = nullptr;
    scene.lighting.lights = std::move(lights);
    scene.layers[0].bump = ConstantLayer{{0.2, -0.1, 0}};
    return scene;
}

/// How far colours are off, relative to the true one and a share of the frame's mean.
inline Spread lit_error(const Pixels& got, const Truth& truth) {
    double mean = 0;
    for (const V& lit : truth.lit) mean += (lit.x + lit.y + lit.z) / (3 * static_cast<double>(truth.lit.size()));
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.lit.size(); ++i)
        if (truth.pixels[i].valid)
            errors.push_back(length(vec_at(got, "lit", i) - truth.lit[i]) / (length(truth.lit[i]) + 0.01 * mean));
    return Spread(std::move(errors));
}

}  // namespace wrinkle::test
