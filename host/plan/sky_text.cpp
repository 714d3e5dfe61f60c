#include <fmt/format.h>

#include <algorithm>

#include "base/vec.h"
#include "plan/planned_numbers.h"
#include "scene/light_extent.h"
#include "scene/sky_axes.h"

namespace wrinkle {

namespace {

/// The numbers of a sky that wr_sky_seen reads.
std::vector<double> numbers_of_sky(const Light& light) {
    const scene::SkyAxes axes = scene::sky_axes(light);
    std::vector<double> numbers;
    for (const Vec3* axis : {&axes.ahead, &axes.aside, &axes.up})
        numbers.insert(numbers.end(), axis->begin(), axis->end());
    const std::array<Vec3, 3> colours = light.harmonics ? std::array{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}
                                                        : std::array{light.zenith, light.horizon, light.ground};
    for (const Vec3& colour : colours)
        for (const double channel : colour) numbers.push_back(channel * light.intensity);
    return numbers;
}

}  // namespace

bool mirrors_sky(const Emitter& emitter) {
    const Lighting& lighting = emitter.scene.lighting;
    return emitter.options.write_normal && lighting.relight != Relight::off &&
           std::ranges::any_of(lighting.lights, scene::is_mirrored);
}

void add_mirrored_skies(Emitter& emitter) {
    if (!mirrors_sky(emitter)) return;
    const auto texture_at = [&](const std::filesystem::path& file, TexelKind kind) {
        return fmt::format("wr_texture_at(texels, textures, {})", emitter.texture({.file = file}, kind));
    };
    std::string text = fmt::format(
        "wr_long_fn wr_vec3 wr_mirrored_skies(wr_vec3 n, wr_vec3 base, wr_vec3 v, wr_real roughness, WR_SCALAR f0,\n"
        "    global const float *texels, global const uint *textures, constant const WR_SCALAR *skies)\n{{\n"
        "    wr_lit_surface at = wr_lit_surface_of(n, base, v, wr_zero3(), roughness);\n"
        "    wr_sky_lobe lobe = wr_sky_lobe_of({}, at, v, f0);\n    wr_vec3 sum = wr_zero3();\n",
        texture_at({}, TexelKind::lobes));
    const std::vector<Light>& lights = emitter.scene.lighting.lights;
    std::size_t count = 0;  // the scene's other lights may come and go
    for (const Light& light : lights) {
        if (!scene::is_mirrored(light)) continue;
        const std::size_t first =
            add_numbers(emitter, fmt::format("sky {}", count + 1), [count](const NumberSource& source) {
                std::vector<Light> skies = source.scene.lighting.lights;
                std::erase_if(skies, [](const Light& l) { return !scene::is_mirrored(l); });
                return numbers_of_sky(skies.at(count));
            });
        ++count;
        text += fmt::format("    sum = wr_add(sum, wr_sky_seen({}, skies + {}, lobe));\n",
                            texture_at(light.harmonics ? light.texture : "", TexelKind::sky), first);
    }
    emitter.helpers += text + "    return wr_scale(sum, lobe.strength);\n}\n\n";
}

}  // namespace wrinkle
