// Deferred shading from an engine's G-buffer as it lies in memory: RGBA8 albedo and roughness, RGBA16F normals, a
// reversed depth buffer with its far plane at infinity. A small rasteriser draws it; decals are accumulated from the
// depth alone, resolved onto the normals, and the result is lit by 1,000 lights. The same from planes of floats tells
// what that costs.
#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <iostream>
#include <memory>
#include <random>
#include <vector>

#include "wrinkle/error.h"
#include "wrinkle/passes.h"

namespace {

using wrinkle::Vec3;

const wrinkle::Size kSize{320, 180};
constexpr std::size_t kPixels = 320 * 180;

struct GBuffer {
    std::vector<std::uint8_t> albedo_roughness = std::vector<std::uint8_t>(4 * kPixels);
    std::vector<std::uint16_t> normal = std::vector<std::uint16_t>(4 * kPixels);  // halves
    std::vector<float> depth = std::vector<float>(kPixels);                       // near / view depth; 0: nothing
};

/// The half nearest to a number of at most 1, and what it stands for.
std::uint16_t to_half(float v) {
    const auto steps = static_cast<std::uint32_t>(std::lround(std::ldexp(std::abs(v), 24)));
    std::uint32_t half = steps;  // below 2^-14 halves are multiples of 2^-24
    if (steps >= 1024) {
        const int drop = std::bit_width(steps) - 11;
        half = (static_cast<std::uint32_t>(drop) << 10) + ((steps + (1u << drop >> 1)) >> drop);
    }
    return static_cast<std::uint16_t>(half | (v < 0 ? 0x8000u : 0));
}
float from_half(std::uint16_t half) {
    const int exponent = half >> 10 & 31, fraction = half & 1023;
    const float size = exponent == 0 ? std::ldexp(static_cast<float>(fraction), -24)
                                     : std::ldexp(static_cast<float>(1024 + fraction), exponent - 25);
    return (half & 0x8000u) != 0 ? -size : size;
}

/// A parallelogram: a corner, two sides, its normal along their cross product.
struct Face {
    Vec3 corner, side_a, side_b, albedo;
    double roughness = 0.5;
};

void draw(GBuffer& g, const wrinkle::Camera& camera, const Face& face) {
    const Vec3 &a = face.side_a, &b = face.side_b;
    const Vec3 n{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    std::array<std::array<double, 3>, 4> corner{};  // pixel coordinates, and what the depth buffer holds
    for (std::size_t k = 0; k < 4; ++k) {
        Vec3 p = face.corner;
        for (std::size_t i = 0; i < 3; ++i) p[i] += (k == 1 || k == 2 ? a[i] : 0) + (k >= 2 ? b[i] : 0);
        const auto at = wrinkle::project(camera, kSize, p).value();
        const auto& z = camera.view[2];
        corner[k] = {at[0], at[1], camera.proj[2][3] / -(z[0] * p[0] + z[1] * p[1] + z[2] * p[2] + z[3])};
    }
    for (const auto& [i, j, k] : {std::array{0, 1, 2}, std::array{0, 2, 3}}) {
        const auto &p = corner[i], &q = corner[j], &r = corner[k];
        const auto area = [](const auto& u, const auto& v, double x, double y) {
            return (v[0] - u[0]) * (y - u[1]) - (v[1] - u[1]) * (x - u[0]);
        };
        const double whole = area(p, q, r[0], r[1]);
        for (std::size_t at = 0; at < kPixels; ++at) {
            const double x = static_cast<double>(at % kSize.width) + 0.5,
                         y = static_cast<double>(at / kSize.width) + 0.5;
            const double of_p = area(q, r, x, y) / whole, of_q = area(r, p, x, y) / whole, of_r = 1 - of_p - of_q;
            if (!(of_p >= 0 && of_q >= 0 && of_r >= 0)) continue;
            const auto depth = static_cast<float>(of_p * p[2] + of_q * q[2] + of_r * r[2]);  // linear on a plane
            if (depth <= g.depth[at]) continue;  // reversed: the nearer is the larger
            g.depth[at] = depth;
            for (std::size_t c = 0; c < 3; ++c) {
                g.albedo_roughness[4 * at + c] = static_cast<std::uint8_t>(std::lround(255 * face.albedo[c]));
                g.normal[4 * at + c] = to_half(static_cast<float>(n[c] / length));
            }
            g.albedo_roughness[4 * at + 3] = static_cast<std::uint8_t>(std::lround(255 * face.roughness));
        }
    }
}

/// A ground with boxes on it.
GBuffer rasterised(const wrinkle::Camera& camera) {
    GBuffer g;
    draw(g, camera, {{-6, -4, 0}, {12, 0, 0}, {0, 12, 0}, {0.5, 0.45, 0.4}, 0.6});
    for (const double x : {-3.0, 0.0, 3.0}) {
        const double s = 1.4, y = 0.4 * x;
        draw(g, camera, {{x, y, s}, {s, 0, 0}, {0, s, 0}, {0.3, 0.5, 0.7}, 0.3});
        draw(g, camera, {{x, y, 0}, {s, 0, 0}, {0, 0, s}, {0.7, 0.4, 0.3}, 0.4});
        draw(g, camera, {{x, y + s, 0}, {0, -s, 0}, {0, 0, s}, {0.6, 0.6, 0.3}, 0.4});
        draw(g, camera, {{x + s, y, 0}, {0, s, 0}, {0, 0, s}, {0.6, 0.6, 0.3}, 0.4});
    }
    return g;
}

/// Studs all over, and lights over all of it.
wrinkle::Layer studs() {
    std::ofstream image("stud.pgm");
    image << "P2 32 32 255\n";
    for (int i = 0; i < 1024; ++i)
        image << std::lround(255 * std::max(0.0, 1 - std::hypot(i % 32 - 15.5, i / 32 - 15.5) / 14)) << ' ';
    std::mt19937 random(1);
    std::uniform_real_distribution<double> within(-4, 4);
    auto rows = std::make_shared<std::vector<wrinkle::Projector>>();
    for (int i = 0; i < 300; ++i)
        rows->push_back({.center = {1.4 * within(random), within(random) + 1, i % 2 == 0 ? 0.0 : 1.4},
                         .half_size = {0.2, 0.2, 0.3},
                         .scale = 0.06});
    wrinkle::Layer layer;
    layer.name = "studs", layer.bump = wrinkle::DecalsLayer{.textures = {{.file = "stud.pgm"}}, .rows = rows};
    return layer;
}

wrinkle::Scene lit_scene() {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    auto lights = std::make_shared<std::vector<wrinkle::Light>>();
    for (int i = 0; i < 1000; ++i)
        lights->push_back({.kind = wrinkle::LightKind::point,
                           .color = {unit(random), unit(random), unit(random)},
                           .intensity = 0.3,
                           .position = {12 * unit(random) - 6, 12 * unit(random) - 4, 0.2 + 2 * unit(random)},
                           .range = 1.2});
    wrinkle::Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "decals", scene.layers[0].bump = wrinkle::GradientLayer{.channels = {"g.X", "g.Y", "g.Z"}};
    scene.lighting.relight = wrinkle::Relight::lit;
    scene.lighting.ambient = {0.05, 0.05, 0.06};
    scene.lighting.table = lights;
    return scene;
}

using Formats = wrinkle::PlaneFormats;

Formats joined(Formats a, const Formats& b) {
    a.insert(b.begin(), b.end());
    return a;
}

/// Runs a pass on memories by name; gives its outputs, whose pixels have at most 8 bytes.
using Memory = std::map<std::string, std::vector<std::byte>>;
Memory run(wrinkle::Pass& pass, const Memory& in) {
    Memory out;
    wrinkle::HostByteOutputs spans;
    for (const std::string& name : pass.outputs()) {
        out[name].resize(8 * kPixels);
        spans[name] = out[name];
    }
    pass.run(wrinkle::HostBytes(in.begin(), in.end()), spans);
    return out;
}

template <class T>
std::vector<std::byte> bytes(const std::vector<T>& values) {
    const auto all = std::as_bytes(std::span(values));
    return {all.begin(), all.end()};
}

}  // namespace

int main() try {
    auto camera = wrinkle::Camera::look_at({0, -9, 5}, {0, 0.5, 0.3}, {0, 0, 1}, 0.7, 16.0 / 9);
    camera.proj[2] = {0, 0, 0, 0.1};  // reversed, from 0.1 m to infinity
    const GBuffer g = rasterised(camera);
    const auto device = wrinkle::Device::open();
    const wrinkle::Layer decals = studs();
    using enum wrinkle::PlaneEncoding;

    // As the engine holds it. Gradients stay in RGBA16F between the passes.
    const Formats gbuffer =
        joined(wrinkle::interleaved("gbuffer0", unorm8, {"albedo.r", "albedo.g", "albedo.b", "roughness"}),
               wrinkle::interleaved("gbuffer1", half, {"normal.x", "normal.y", "normal.z", ""}));
    wrinkle::Frame frame{
        .size = kSize,
        .camera = camera,
        .planes = {"depth", "albedo.r", "albedo.g", "albedo.b", "roughness", "normal.x", "normal.y", "normal.z"},
        .formats = gbuffer,
        .device_depth = wrinkle::DeviceDepth::zero_to_one};
    wrinkle::PassOptions to_gradient, to_lit;
    to_gradient.output_formats =
        wrinkle::interleaved("gradient", half, {"volume_gradient.x", "volume_gradient.y", "volume_gradient.z", ""});
    to_lit.output_formats = wrinkle::interleaved("lit", half, {"lit.r", "lit.g", "lit.b", ""});
    const wrinkle::Frame depth_alone{
        .size = kSize, .camera = camera, .planes = {"depth"}, .device_depth = frame.device_depth};
    auto accumulate = wrinkle::accumulate_decals(device, {&decals, 1}, depth_alone, to_gradient);
    Memory memory{{"gbuffer0", bytes(g.albedo_roughness)}, {"gbuffer1", bytes(g.normal)}, {"depth", bytes(g.depth)}};
    memory.merge(run(accumulate, memory));
    frame.planes.insert({"channel:g.X", "channel:g.Y", "channel:g.Z"});
    frame.formats =
        joined(gbuffer, wrinkle::interleaved("gradient", half, {"channel:g.X", "channel:g.Y", "channel:g.Z", ""}));
    auto shade = wrinkle::evaluate(device, lit_scene(), frame, to_lit);
    const Memory packed = run(shade, memory);

    // The same from floats.
    Memory floats{{"depth", bytes(g.depth)}};
    for (std::size_t c = 0; c < 4; ++c) {
        std::vector<float> albedo(kPixels), normal(kPixels);
        for (std::size_t i = 0; i < kPixels; ++i) {
            albedo[i] = static_cast<float>(g.albedo_roughness[4 * i + c]) / 255;
            normal[i] = from_half(g.normal[4 * i + c]);
        }
        floats[c < 3 ? std::string("albedo.") + "rgb"[c] : "roughness"] = bytes(albedo);
        if (c < 3) floats[std::string("normal.") + "xyz"[c]] = bytes(normal);
    }
    auto accumulate_floats = wrinkle::accumulate_decals(device, {&decals, 1}, depth_alone);
    for (auto& [name, plane] : run(accumulate_floats, floats))
        floats[std::string("channel:g.") + static_cast<char>(name.back() - 'x' + 'X')] = plane;
    frame.formats.clear();
    auto shade_floats = wrinkle::evaluate(device, lit_scene(), frame);
    const Memory plain = run(shade_floats, floats);

    // Colours of both, and the picture.
    std::ofstream picture("deferred.ppm", std::ios::binary);
    picture << "P6 " << kSize.width << ' ' << kSize.height << " 255\n";
    double off = 0, brightness = 0;
    for (std::size_t i = 0; i < 3 * kPixels; ++i) {
        const float want = reinterpret_cast<const float*>(plain.at(std::string("lit.") + "rgb"[i % 3]).data())[i / 3];
        const float got =
            from_half(reinterpret_cast<const std::uint16_t*>(packed.at("lit").data())[4 * (i / 3) + i % 3]);
        if (!std::isfinite(got) || !std::isfinite(want)) throw std::runtime_error("a colour is not finite");
        off = std::max(off, std::abs(static_cast<double>(got) - want) / (0.05 + want)), brightness += want;
        picture.put(static_cast<char>(std::lround(255 * std::pow(std::clamp(got, 0.0f, 1.0f), 1 / 2.2f))));
    }
    std::cout << accumulate.bytes_per_pixel() + shade.bytes_per_pixel() << " bytes a pixel instead of "
              << accumulate_floats.bytes_per_pixel() + shade_floats.bytes_per_pixel() << ", colours off by " << off
              << " of themselves at most, mean " << brightness / static_cast<double>(3 * kPixels) << '\n';
    return off < 0.02 && brightness > 0.05 * 3 * kPixels ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
