#include "selftest/scenes.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "base/atomic_file.h"
#include "io/volume_file.h"
#include "wrinkle/error.h"

namespace wrinkle::selftest {

namespace fs = std::filesystem;

namespace {

constexpr int kTexels = 16;

/// Heights as bytes that repeat, in rows of 16.
std::string height_image() {
    std::string image = "P5 16 16 255\n";
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x) image += static_cast<char>((x * 7 + y * 5 + (x / 4 + y / 4) % 2 * 60) % 128);
    return image;
}

/// Normals that lean by up to 40 degrees, as bytes.
std::string normal_image() {
    std::string image = "P6 16 16 255\n";
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x)
            image += {static_cast<char>(64 + x * 8), static_cast<char>(192 - y * 8), static_cast<char>(230)};
    return image;
}

void write_volume(const fs::path& file) {
    DenseVolume volume;
    volume.first = {-8, -8, 0}, volume.size = {16, 16, 16};
    volume.world_from_index = {{{0.25, 0, 0, 0}, {0, 0.25, 0, 0}, {0, 0, 0.25, -1}, {0, 0, 0, 1}}};
    for (int i = 0; i < 16 * 16 * 16; ++i) volume.values.push_back(static_cast<float>(i % 7 * (i / 16 % 5)) / 16);
    save_volume(file, volume);
}

Layer layer(const std::string& name, auto bump, double scale) {
    Layer out;
    out.name = name, out.bump = std::move(bump), out.scale = scale;
    return out;
}

Scene scene_of(std::vector<Layer> layers) {
    Scene scene;
    scene.layers = std::move(layers);
    scene.filter.taps = 1;
    return scene;
}

Scene lit_scene() {
    Scene scene = scene_of({layer("grain", NoiseLayer{.frequency = 1.5}, 0.05)});
    scene.lighting.relight = Relight::lit;
    scene.lighting.ambient = {0.1, 0.12, 0.15};
    scene.lighting.lights = {
        {.kind = LightKind::sun, .color = {1, 0.9, 0.8}, .direction = {0.5, 0.5, -0.75}},
        {.kind = LightKind::point, .intensity = 4, .position = {-1, -1.5, 1.5}},
        {.kind = LightKind::spot, .intensity = 9, .position = {1, -1, 3}, .direction = {-0.25, 0.25, -1}}};
    return scene;
}

/// A box, a ball and a cone over the ground and the ball on it.
DecalsLayer table(const TextureUse& heights) {
    Projector box{.center = {-0.4, -0.5, 0.2}, .half_size = {0.7, 0.7, 0.7}, .scale = 0.05};
    Projector ball{
        .shape = ProjectorShape::sphere, .center = {0.5, -0.5, 0.5}, .half_size = {0.9, 0.9, 0.9}, .scale = 0.08};
    Projector cone{.shape = ProjectorShape::cone, .center = {0, 0.2, 1}, .half_size = {0.7, 0.7, 1}, .scale = 0.06};
    for (Projector* row : {&box, &ball, &cone}) row->two_sided = true, row->angle_fade = {-1, -0.5};
    DecalsLayer layer;
    layer.textures = {heights};
    layer.rows = std::make_shared<const std::vector<Projector>>(std::vector{box, ball, cone});
    return layer;
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "wrinkle-check-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw Error("cannot make a folder for a moment: " + name);
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::vector<CheckedScene> checked_scenes(const fs::path& folder) {
    for (const auto& [name, text] :
         {std::pair("heights.pgm", height_image()), std::pair("normals.ppm", normal_image())}) {
        AtomicFile file(folder / name);
        file.write(text);
        file.commit();
    }
    write_volume(folder / "volume.vdb");
    const TextureUse heights{.file = folder / "heights.pgm"};
    const UvMapping ground{.source = UvSource::planar, .scale = {1.5, 1.5}, .rotation = 0.4};
    Layer on_ball =
        layer("normals",
              NormalMapLayer{.texture = {.file = folder / "normals.ppm", .content = Content::normal}, .uv = ground}, 1);
    on_ball.mask.object = {2};
    const auto noise = [](const char* name, NoiseLayer noise) { return layer(name, noise, 0.04); };
    TriplanarLayer triplanar{.texture = heights};
    triplanar.planes[2] = PlaneSource{.content = NoiseLayer{.frequency = 1, .octaves = 3}};
    // Bounds are about four times what PoCL 3.1 errs by at 16 lanes.
    const Layer slope = layer("slope", ConstantLayer{{0.25, -0.125, 0.5}}, 1);
    return {
        {"constant", scene_of({slope}), {3e-6, 2e-5, 5e-5}, {}},
        {"noise",
         scene_of({noise("perlin", {.frequency = 1, .octaves = 4}),
                   noise("simplex",
                         {.frequency = 0.75, .octaves = 3, .type = NoiseType::simplex, .fractal = FractalKind::ridged}),
                   noise("cells", {.frequency = 1.25, .type = NoiseType::worley})}),
         {7e-4, 4e-3, 6e-3},
         {}},
        {"maps",
         scene_of({layer("heights", HeightMapLayer{.texture = heights}, 0.05), on_ball}),
         {3e-6, 3e-4, 6e-4},
         {}},
        {"triplanar", scene_of({layer("heights and noise", triplanar, 0.06)}), {1e-4, 7e-4, 1e-3}, {}},
        {"volume",
         scene_of({layer("voxels", VolumeLayer{.file = folder / "volume.vdb", .filter = VolumeFilter::smooth}, 0.05)}),
         {1e-5, 5e-5, 1e-4},
         {}},
        {"decals", scene_of({layer("table", table(heights), 1)}), {5e-6, 3e-5, 5e-5}, {}},
        {"resolve",
         scene_of({slope, layer("again", ResolveLayer{}, 1), noise("fine", {.frequency = 1.5})}),
         {6e-5, 5e-4, 8e-4},
         {}},
        {"parallax",
         scene_of({layer("deep", ParallaxLayer{.texture = heights, .uv = ground, .steps = 16}, 0.05),
                   noise("grain", {.frequency = 1})}),
         {8e-5, 5e-4, 7e-4},
         {}},
        {"lighting", lit_scene(), {1.2e-4, 8e-4, 1.2e-3}, {8e-7, 8e-6, 1.2e-5}},
    };
}

}  // namespace wrinkle::selftest
