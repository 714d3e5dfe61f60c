#pragma once

#include <random>

#include "tests/reference/projector.h"
#include "tests/run/run_frame.h"

/// Tables of random decals on frames.
namespace wrinkle::test {

/// A scene of one table whose decals hold heights, with one point a pixel.
inline Scene table_scene(std::vector<Projector> rows) {
    DecalsLayer layer;
    layer.textures = {{.file = data_folder / "textures/seal_height.png"}};
    layer.rows = std::make_shared<const std::vector<Projector>>(std::move(rows));
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "many";
    scene.layers[0].bump = std::move(layer);
    scene.filter.taps = 1;
    return scene;
}

struct Random {
    std::mt19937 engine;
    explicit Random(unsigned seed) : engine(seed) {}
    double in(double low, double high) { return low + (high - low) * (engine() / 4294967296.0); }
    Vec3 box(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
};

inline Projector random_decal(Random& random, const Vec3& center, double half) {
    Projector p;
    p.shape = static_cast<ProjectorShape>(random.engine() % 3);
    p.center = center;
    p.axis_x = random.box(1);
    p.axis_y = random.box(1);
    p.half_size = {half * random.in(0.2, 1), half * random.in(0.2, 1), half * random.in(0.2, 1)};
    p.two_sided = true;
    p.angle_fade = {-1, -0.5};
    return p;
}

/// The world positions of a frame's pixels, by the reference, moved by those of `layers` that are parallaxes.
inline std::vector<std::optional<V>> positions(const HostFrame& frame, std::vector<Layer> layers = {}) {
    Scene scene;
    scene.layers = std::move(layers);
    std::erase_if(scene.layers, [](const Layer& layer) { return std::holds_alternative<DecalsLayer>(layer.bump); });
    const Truth truth(frame, scene);
    const V eye = reference::CameraRays<double>(frame.frame.camera, frame.frame.size).eye();
    std::vector<std::optional<V>> out(frame.count());
    for (std::size_t i = 0; i < frame.count(); ++i)
        if (truth.pixels[i].valid) out[i] = truth.pixels[i].position + eye;
    return out;
}

/// Decals around some of the points.
inline std::vector<Projector> decals_around(const std::vector<std::optional<V>>& points, std::size_t count, double low,
                                            double high, unsigned seed) {
    Random random(seed);
    std::vector<Projector> rows;
    while (rows.size() < count) {
        const auto& p = points[random.engine() % points.size()];
        if (!p) continue;
        const double half = low * std::pow(high / low, random.in(0, 1));
        const Vec3 off = random.box(half);
        rows.push_back(random_decal(random, {p->x + off[0], p->y + off[1], p->z + off[2]}, half));
    }
    return rows;
}

inline std::vector<Projector> on_surfaces(const HostFrame& frame, std::size_t count, double low, double high,
                                          unsigned seed) {
    return decals_around(positions(frame), count, low, high, seed);
}

/// Stacks of layers that move points: up, down, twice, with a turn of the normal in between, and after a resolve.
inline std::vector<std::pair<std::string, std::vector<Layer>>> parallax_stacks() {
    const auto parallax = [](const char* name, ParallaxLayer bump, double depth) {
        bump.texture.file = data_folder / "textures/cobbles_height.png";
        bump.uv = {.source = UvSource::planar, .scale = {0.3, 0.3}};
        Layer layer;
        layer.name = name, layer.bump = bump, layer.scale = depth;
        return layer;
    };
    const Layer up = parallax("up", {}, 0.4), down = parallax("down", {.level = 1, .curved = true}, 0.3);
    const Layer step = parallax("step", {.mode = ParallaxMode::offset, .level = 0.5}, 0.5);
    Layer tilt, resolve;
    tilt.name = "tilt", tilt.bump = ConstantLayer{{0.6, -0.3, 0.2}};
    resolve.name = "resolve", resolve.bump = ResolveLayer{};
    return {{"raised", {up}},
            {"carved", {down}},
            {"one step", {step}},
            {"turned, then raised", {down, up}},
            {"resolved, then raised", {tilt, resolve, up}}};
}

}  // namespace wrinkle::test
