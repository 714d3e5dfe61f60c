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
    Bump bump;
    bool footprint = true;
    int lanes = 0;  ///< 0: the device's own
};

/// All ways to measure. Ways of one name do the same job and differ in their variant or number of lanes.
std::vector<Way> ways(int lanes) {
    std::vector<Way> all;
    const auto add = [&](const std::string& name, const Bump& bump, bool footprint, bool on_others) {
        all.push_back({name, "standard", bump, footprint});
        if (!on_others) return;
        for (const int width : {1, 4, 8, 16})
            if (width != lanes) all.push_back({name, "standard", bump, footprint, width});
    };
    for (const int octaves : {2, 4, 8}) {
        NoiseLayer noise{.frequency = 0.25, .octaves = octaves};
        const std::string name = fmt::format("noise_{}_octaves", octaves);
        add(name, noise, false, octaves == 8);
        noise.gradient = NoiseGradient::forward;
        all.push_back({name, "forward differences", noise, false});
    }
    HeightMapLayer map;
    map.texture.file = WRINKLE_SOURCE_DIR "/data/textures/cobbles_height.png";
    map.uv = {.source = UvSource::planar, .scale = {0.7, 0.7}};
    for (const bool mips : {true, false})
        for (const auto& [upscale, variant] :
             {std::pair{Upscale::plain, "bilinear"}, {Upscale::smooth, "smooth"}, {Upscale::taps, "taps"}}) {
            map.texture.upscale = upscale;
            add(fmt::format("height_map_{}_{}", variant, mips ? "mips" : "level_0"), map, mips,
                mips && upscale == Upscale::smooth);
        }
    KernelLayer dents{.function = "dents", .parameters = {{"spacing", 0.35}, {"radius", 0.45}, {"depth", 1}}};
    dents.file = WRINKLE_SOURCE_DIR "/data/kernels/dents.clh";
    add("kernel_dents", dents, true, false);
    dents.file = WRINKLE_SOURCE_DIR "/bench/kernels/dents_by_hand.clh";
    all.push_back({"kernel_dents", "gradient by hand", dents});
    return all;
}

}  // namespace

void measure_variants(const Device& device, Size size, Run& run) {
    Scene base = load_scene(stack_scene());
    const BenchFrame frame = Resampler(base).frame({size.width / 2, size.height / 2});
    base = without_lighting(base, frame.frame);
    const std::vector<Way> all = ways(device.info.lanes);
    const auto scene_of = [&](const Way& way) {
        Scene scene = base;
        scene.layers.assign(1, {});
        scene.layers[0].name = way.name, scene.layers[0].bump = way.bump;
        scene.layers[0].scale = 0.05, scene.layers[0].footprint = way.footprint;
        return scene;
    };
    std::deque<Resident> residents;
    std::vector<Contender> contenders;
    for (const Way& way : all) {
        Resident& resident = residents.emplace_back(device, scene_of(way), frame, PassOptions{.lanes = way.lanes});
        contenders.push_back({way.variant, [&resident] { resident.run(); }});
    }
    race(contenders, run.rounds);
    for (std::size_t k = 0; k < all.size(); ++k) {
        const ReferenceSample reference(scene_of(all[k]), frame, kErrorSamples, kSeed);
        run.measurements.push_back(scene_measurement(
            "variant", all[k].name, all[k].variant, all[k].lanes == 0 ? device.info.lanes : all[k].lanes,
            contenders[k].seconds, residents[k].pass, residents[k].normals(frame.pixels()), reference));
    }
}

}  // namespace wrinkle::bench
