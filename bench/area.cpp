#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <optional>
#include <random>

#include "contests.h"
#include "resident.h"
#include "tests/reference/evaluate.h"
#include "tests/reference/scene_images.h"
#include "texture_system.h"

namespace wrinkle::bench {

namespace {

constexpr Size kSize{480, 270};
constexpr std::uint32_t kPoints = 32;  // of the truth, along each side of a pixel
constexpr int kColumns = 6;            // of pixels that have a truth

const std::filesystem::path kTextures = WRINKLE_SOURCE_DIR "/data/textures";

/// A ground to the horizon, seen from 1.6 m up.
class Ground {
public:
    Ground()
        : camera_(Camera::look_at({0, -6, 1.6}, {0, 0, 0.6}, {0, 0, 1}, 0.6981317007977318,
                                  static_cast<double>(kSize.width) / kSize.height)) {}

    /// The frame with `factor` x `factor` pixels for each of kSize.
    BenchFrame frame(std::uint32_t factor) const {
        return window({kSize.width * factor, kSize.height * factor}, 0, 0,
                      {kSize.width * factor, kSize.height * factor});
    }

    /// The points of a column of pixels of kSize, as a frame of their own.
    BenchFrame column(std::uint32_t x) const {
        return window({kSize.width * kPoints, kSize.height * kPoints}, x * kPoints, 0,
                      {kPoints, kSize.height * kPoints});
    }

private:
    /// Pixels [left, left + size) of a frame of `whole`; their camera sees the window alone.
    BenchFrame window(Size whole, std::uint32_t left, std::uint32_t top, Size size) const {
        const double wide = static_cast<double>(whole.width) / size.width,
                     high = static_cast<double>(whole.height) / size.height;
        Camera camera = camera_;
        // NDC of the window: x' = wide (x + 1) - 1 - 2 left / size.
        for (std::size_t k = 0; k < 4; ++k) {
            const double w = camera_.proj[3][k];
            camera.proj[0][k] = wide * camera_.proj[0][k] + (wide - 1 - 2.0 * left / size.width) * w;
            camera.proj[1][k] = high * camera_.proj[1][k] - (high - 1 - 2.0 * top / size.height) * w;
        }
        BenchFrame out;
        out.frame.size = size;
        out.frame.camera = camera;
        for (const char* name : {"depth", "normal.x", "normal.y", "normal.z", "uv.u", "uv.v"}) {
            out.frame.planes.insert(name);
            out.planes[name].resize(std::size_t{size.width} * size.height);
        }
        const PinholeRays rays = pinhole_rays(camera, size).value();
        for (std::size_t i = 0; i < out.planes["depth"].size(); ++i) {
            const double x = static_cast<double>(i % size.width) + 0.5, y = static_cast<double>(i / size.width) + 0.5;
            Vec3 d{};
            for (std::size_t k = 0; k < 3; ++k) d[k] = rays.d0[k] + x * rays.dx[k] + y * rays.dy[k];
            const double depth = -rays.eye[2] / d[2];
            const bool seen = depth > 0 && depth < 2000;
            out.planes["depth"][i] = seen ? static_cast<float>(depth) : 1e10f;
            out.planes["normal.z"][i] = 1;
            out.planes["uv.u"][i] = seen ? static_cast<float>((rays.eye[0] + depth * d[0]) / kGroundRepeat) : 0;
            out.planes["uv.v"][i] = seen ? static_cast<float>((rays.eye[1] + depth * d[1]) / kGroundRepeat) : 0;
        }
        return out;
    }

    Camera camera_;
};

/// The mean surface gradient over the area of some pixels, by the double-precision reference at 1024 points of each.
struct Truth {
    std::vector<std::size_t> pixels;
    std::vector<std::array<double, 3>> normals;

    Truth(const Ground& ground, Scene scene) {
        for (Layer& layer : scene.layers) layer.footprint = false;
        const reference::Images images = reference::images_of(scene);
        std::mt19937 random(kSeed);
        std::uniform_int_distribution<std::uint32_t> column(0, kSize.width - 1);
        for (int k = 0; k < kColumns; ++k) {
            const std::uint32_t x = column(random);
            add(scene, images, ground.column(x), x);
        }
    }

    ErrorStats compare(const std::vector<std::array<double, 3>>& got) const {
        std::vector<double> degrees;
        for (std::size_t k = 0; k < pixels.size(); ++k) {
            const auto &a = got[pixels[k]], &b = normals[k];
            const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
            degrees.push_back(std::atan2(std::hypot(x, y, z), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) *
                              57.29577951308232);
        }
        return statistics(std::move(degrees));
    }

private:
    void add(const Scene& scene, const reference::Images& images, const BenchFrame& points, std::uint32_t x) {
        reference::Planes planes;
        for (const auto& [name, plane] : points.planes) planes[name] = plane;
        const reference::SceneEvaluator<double> evaluator(scene, points.frame.size, points.frame.camera, planes,
                                                          images);
        constexpr std::size_t count = std::size_t{kPoints} * kPoints;
        for (std::uint32_t y = 0; y < kSize.height; ++y) {
            std::array<double, 3> normal{0, 0, 1};
            bool whole = true;
            for (std::size_t i = 0; i < count && whole; ++i) {
                const auto at = evaluator.evaluate(y * count + i);
                whole = at.valid;
                normal[0] -= at.surface_gradient.x / count, normal[1] -= at.surface_gradient.y / count;
            }
            if (!whole) continue;
            pixels.push_back(std::size_t{y} * kSize.width + x);
            normals.push_back(normal);
        }
    }
};

/// Normals of a frame of factor x factor points a pixel: of the mean surface gradient.
std::vector<std::array<double, 3>> averaged(const Normals& n, std::uint32_t factor) {
    std::vector<std::array<double, 3>> out(std::size_t{kSize.width} * kSize.height, {0, 0, 1});
    const std::size_t width = std::size_t{kSize.width} * factor;
    const double share = 1.0 / (factor * factor);
    for (std::size_t i = 0; i < n.x.size(); ++i) {
        if (!(n.z[i] > 0)) continue;
        auto& mean = out[i / width / factor * kSize.width + i % width / factor];
        mean[0] += double{n.x[i]} / double{n.z[i]} * share, mean[1] += double{n.y[i]} / double{n.z[i]} * share;
    }
    return out;
}

/// What is bumped.
struct Source {
    const char* name;
    Layer layer;
};

std::vector<Source> sources() {
    const auto layer = [](auto bump, double scale) {
        Layer out;
        out.name = "bump", out.bump = std::move(bump), out.scale = scale;
        return out;
    };
    const NoiseLayer sum{.frequency = 2, .octaves = 6};
    NoiseLayer ridges = sum;
    ridges.fractal = FractalKind::ridged;
    return {{"cobbles", layer(HeightMapLayer{.texture = {.file = kTextures / "cobbles_height.png"}}, 0.05)},
            {"normal map",
             layer(NormalMapLayer{.texture = {.file = kTextures / "weave_normal.png", .content = Content::normal}}, 1)},
            {"noise", layer(sum, 0.06)},
            {"ridges", layer(ridges, 0.06)},
            {"triplanar", layer(TriplanarLayer{.texture = {.file = kTextures / "rock_height.png"}, .tile = 0.6}, 0.1)},
            {"volume", layer(VolumeLayer{.file = WRINKLE_SOURCE_DIR "/data/volumes/noise.vdb",
                                         .grid = "density",
                                         .transform = {{{8, 0, 0, -4}, {0, 8, 0, -6}, {0, 0, 8, -4}, {0, 0, 0, 1}}}},
                             0.6)},
            {"decal",
             layer(DecalLayer{.texture = {.file = kTextures / "cracks_height.png"}, .half_size = {2, 4, 0.5}}, 0.2)}};
}

/// The same slopes by OpenImageIO, where the layer is a height or normal map.
std::optional<TextureSystemSlopes> by_texture_system(const Layer& layer, const Ground& ground) {
    if (const auto* map = std::get_if<HeightMapLayer>(&layer.bump))
        return TextureSystemSlopes(map->texture, layer.scale / kGroundRepeat, ground.frame(1));
    if (const auto* map = std::get_if<NormalMapLayer>(&layer.bump))
        return TextureSystemSlopes(map->texture, layer.scale, ground.frame(1));
    return std::nullopt;
}

}  // namespace

void measure_area(const Device& device, Run& run) {
    const Ground ground;
    struct Way {
        std::string name;
        int taps;
        std::uint32_t factor;
    };
    const Way ways[] = {{"no bump", 0, 1},  {"1 tap", 1, 1}, {"2 taps", 2, 1}, {"4 taps", 4, 1}, {"8 taps", 8, 1},
                        {"16 taps", 16, 1}, {"2 x 2", 1, 2}, {"4 x 4", 1, 4},  {"8 x 8", 1, 8}};
    for (const Source& source : sources()) {
        Scene scene;
        scene.layers = {source.layer};
        const Truth truth(ground, scene);
        std::deque<Resident> residents;
        std::vector<Contender> contenders;
        for (const Way& way : ways) {
            Scene own = scene;
            own.filter.taps = std::max(way.taps, 1);
            if (way.taps == 0) own.layers[0].bump = ConstantLayer{};  // what the bump tilts normals by
            if (way.factor > 1) own.layers[0].footprint = false;
            Resident& resident = residents.emplace_back(device, own, ground.frame(way.factor));
            contenders.push_back({way.name, [&resident] { resident.run(); }});
        }
        std::optional<TextureSystemSlopes> system = by_texture_system(source.layer, ground);
        if (system) contenders.push_back({"TextureSystem", [&system] { system->run(); }});
        race(contenders, few(run.rounds));
        if (system) {
            Measurement m = measured("area", source.name, contenders.back(), 0, ground.frame(1).pixels());
            m.error = truth.compare(system->normals());
            run.measurements.push_back(std::move(m));
        }
        for (std::size_t k = 0; k < residents.size(); ++k) {
            const std::size_t points = std::size_t{kSize.width} * kSize.height * ways[k].factor * ways[k].factor;
            const Normals normals = residents[k].normals(points);
            Measurement m = measured("area", source.name, contenders[k], device.info.lanes,
                                     std::size_t{kSize.width} * kSize.height);
            m.bytes = bytes_of(residents[k].pass) * ways[k].factor * ways[k].factor;
            m.error = truth.compare(averaged(normals, ways[k].factor));
            m.hash = hash_of(normals.x.data(), points * sizeof(float));
            run.measurements.push_back(std::move(m));
        }
    }
}

}  // namespace wrinkle::bench
