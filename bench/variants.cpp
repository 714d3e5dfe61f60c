#include <fmt/format.h>

#include <deque>

#include "contests.h"
#include "resident.h"

namespace wrinkle::bench {

namespace {

using Bump = decltype(Layer::bump);

/// One way to bump every pixel of the frame.
struct Way {
    std::string name, variant;
    Bump bump, meant;  ///< what it computes, and what that stands for: the difference is its error
    bool footprint = true;
    int lanes = 0;  ///< 0: the device's own
};

std::vector<Way> ways(int lanes) {
    std::vector<Way> all;
    for (const int octaves : {2, 4, 8}) {
        NoiseLayer noise{.frequency = 0.25, .octaves = octaves};
        const NoiseLayer exact = noise;
        all.push_back({"noise", fmt::format("{} octaves", octaves), noise, exact, false});
        noise.gradient = NoiseGradient::forward;
        all.push_back({"noise", fmt::format("{} octaves, forward differences", octaves), noise, exact, false});
    }
    HeightMapLayer map;
    map.texture.file = WRINKLE_SOURCE_DIR "/data/textures/cobbles_height.png";
    map.uv = {.source = UvSource::planar, .scale = {0.7, 0.7}};
    for (const bool mips : {true, false})
        for (const auto& [upscale, variant] :
             {std::pair{Upscale::plain, "bilinear"}, {Upscale::smooth, "smooth"}, {Upscale::taps, "three taps"}}) {
            map.texture.upscale = upscale;
            all.push_back({"height_map", fmt::format("{}, {}", variant, mips ? "mips" : "level 0"), map, map, mips});
        }
    for (const std::size_t of : {std::size_t{4}, std::size_t{7}})  // 8 octaves; smooth, mips
        for (const int narrow : {1, 4, 8, 16}) {
            Way way = all[of];
            way.lanes = narrow;
            if (narrow != lanes) all.push_back(std::move(way));
        }
    return all;
}

}  // namespace

void measure_variants(const Device& device, Size size, Run& run) {
    Scene base = load_scene(stack_scene());
    const BenchFrame frame = Resampler(base).frame({size.width / 2, size.height / 2});
    base = without_lighting(base, frame.frame);
    const std::vector<Way> all = ways(device.info.lanes);
    const auto scene_of = [&](const Way& way, const Bump& bump) {
        Scene scene = base;
        scene.layers.assign(1, {});
        scene.layers[0].name = way.name, scene.layers[0].bump = bump;
        scene.layers[0].scale = 0.05, scene.layers[0].footprint = way.footprint;
        return scene;
    };
    std::deque<Resident> residents;
    std::vector<Contender> contenders;
    for (const Way& way : all) {
        Resident& resident =
            residents.emplace_back(device, scene_of(way, way.bump), frame, PassOptions{.lanes = way.lanes});
        contenders.push_back({way.variant, [&resident] { resident.run(); }});
    }
    race(contenders, run.rounds);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const ReferenceSample reference(scene_of(all[k], all[k].meant), frame, kErrorSamples, kSeed);
        run.measurements.push_back(scene_measurement(
            "variant", all[k].name, all[k].variant, all[k].lanes == 0 ? device.info.lanes : all[k].lanes,
            contenders[k].seconds, residents[k].pass, residents[k].normals(frame.pixels()), reference));
    }
}

}  // namespace wrinkle::bench
