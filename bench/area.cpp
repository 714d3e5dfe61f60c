#include <fmt/format.h>

#include <cmath>
#include <deque>
#include <optional>

#include "area_truth.h"
#include "contests.h"
#include "resident.h"
#include "texture_system.h"

namespace wrinkle::bench {

namespace {

const std::filesystem::path kTextures = WRINKLE_SOURCE_DIR "/data/textures";

/// Normals of a frame of factor x factor points a pixel: of the mean surface gradient.
Vectors averaged(const AreaSurface& surface, const Normals& bumped, std::uint32_t factor) {
    Vectors out = own_normals(surface);
    const BenchFrame frame = surface.frame(factor);
    const std::vector<float>*own[] = {&frame.planes.at("normal.x"), &frame.planes.at("normal.y"),
                                      &frame.planes.at("normal.z")},
          *got[] = {&bumped.x, &bumped.y, &bumped.z};
    const double share = 1.0 / (factor * factor);
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
        double cosine = 0;
        for (std::size_t k = 0; k < 3; ++k) cosine += double{(*own[k])[i]} * double{(*got[k])[i]};
        if (!(cosine > 0)) continue;
        auto& mean =
            out[i / frame.frame.size.width / factor * surface.size.width + i % frame.frame.size.width / factor];
        for (std::size_t k = 0; k < 3; ++k)  // minus the gradient, n - m / (n . m)
            mean[k] += (double{(*got[k])[i]} / cosine - double{(*own[k])[i]}) * share;
    }
    return out;
}

/// What is bumped.
struct Source {
    const char* name;
    Layer layer;
};

std::vector<Source> sources(const AreaSurface& surface) {
    const auto layer = [](auto bump, double scale) {
        Layer out;
        out.name = "bump", out.bump = std::move(bump), out.scale = scale;
        return out;
    };
    const NoiseLayer sum{.frequency = 2, .octaves = 6};
    const double side = surface.volume_side, middle = surface.volume_middle;
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
                                         .transform = {{{side, 0, 0, -side / 2},
                                                        {0, side, 0, -side * middle},
                                                        {0, 0, side, -side / 2},
                                                        {0, 0, 0, 1}}}},
                             0.6)},
            {"decal", layer(DecalLayer{.texture = {.file = kTextures / "cracks_height.png"},
                                       .center = surface.decal_center,
                                       .axis_x = surface.decal_x,
                                       .axis_y = surface.decal_y,
                                       .half_size = {2, 4, 0.5}},
                            0.2)}};
}

/// The same slopes by OpenImageIO, where the layer is a height or normal map on the ground.
std::optional<TextureSystemSlopes> by_texture_system(const Layer& layer, const AreaSurface& surface) {
    if (surface.name != "ground") return std::nullopt;
    if (const auto* map = std::get_if<HeightMapLayer>(&layer.bump))
        return TextureSystemSlopes(map->texture, layer.scale / kGroundRepeat, surface.frame(1));
    if (const auto* map = std::get_if<NormalMapLayer>(&layer.bump))
        return TextureSystemSlopes(map->texture, layer.scale, surface.frame(1));
    return std::nullopt;
}

struct Way {
    std::string name;
    int taps;
    std::uint32_t factor;
};
const std::vector<Way> kWays{{"no bump", 0, 1},  {"1 tap", 1, 1}, {"2 taps", 2, 1}, {"4 taps", 4, 1}, {"8 taps", 8, 1},
                             {"16 taps", 16, 1}, {"2 x 2", 1, 2}, {"4 x 4", 1, 4},  {"8 x 8", 1, 8}};

void measure(const Device& device, const AreaSurface& surface, const Source& source, Run& run) {
    // The ground's records have no surface in their names: they are older than the others.
    const std::string name = surface.name == "ground" ? source.name : fmt::format("{}, {}", source.name, surface.name);
    Scene scene;
    scene.layers = {source.layer};
    const AreaTruth truth(surface, scene);
    const std::size_t pixels = surface.frame(1).pixels();
    std::deque<Resident> residents;
    std::vector<Contender> contenders;
    for (const Way& way : kWays) {
        Scene own = scene;
        own.filter.taps = std::max(way.taps, 1);
        if (way.taps == 0) own.layers[0].bump = ConstantLayer{};  // what the bump tilts normals by
        if (way.factor > 1) own.layers[0].footprint = false;
        Resident& resident = residents.emplace_back(device, own, surface.frame(way.factor));
        contenders.push_back({way.name, [&resident] { resident.run(); }});
    }
    std::optional<TextureSystemSlopes> system = by_texture_system(source.layer, surface);
    if (system) contenders.push_back({"TextureSystem", [&system] { system->run(); }});
    race(contenders, few(run.rounds));
    if (system) {
        Measurement m = measured("area", name, contenders.back(), 0, pixels);
        m.error = truth.compare(system->normals());
        run.measurements.push_back(std::move(m));
    }
    for (std::size_t k = 0; k < residents.size(); ++k) {
        const std::size_t points = pixels * kWays[k].factor * kWays[k].factor;
        const Normals normals = residents[k].normals(points);
        Measurement m = measured("area", name, contenders[k], device.info.lanes, pixels);
        m.bytes = bytes_of(residents[k].pass) * kWays[k].factor * kWays[k].factor;
        m.error = truth.compare(averaged(surface, normals, kWays[k].factor));
        m.hash = hash_of(normals.x.data(), points * sizeof(float));
        run.measurements.push_back(std::move(m));
    }
}

}  // namespace

void measure_area(const Device& device, Run& run) {
    for (const AreaSurface& surface : area_surfaces())
        for (const Source& source : sources(surface)) measure(device, surface, source, run);
}

}  // namespace wrinkle::bench
