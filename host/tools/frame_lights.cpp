#include "tools/frame_lights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/light_json.h"
#include "tools/frame_surfaces.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::uint32_t kSomeRows = 8;                 // bands that are read to tell how strong named lights are
constexpr std::size_t kMostNamed = 3;                  // lights whose strength is told from the picture
constexpr double kExplained = 0.2, kLeastShare = 0.1;  // else their strength is a guess
constexpr double kAgree = 1.7;                         // factors of lights may differ by so much

/// The lights of a scene but for skies.
std::vector<Light> lamps_of(const Lighting& lighting) {
    std::vector<Light> lamps;
    std::ranges::copy_if(lighting.lights, std::back_inserter(lamps),
                         [](const Light& light) { return light.kind != LightKind::sky; });
    return lamps;
}

/// How far numbers of a fit can be trusted, by what it leaves unexplained.
const char* trust(const LightFit& fit) {
    return fit.median < 0.08 && fit.p90 < 0.3 ? "they explain the picture well"
           : fit.median < 0.2                 ? "they explain most of the picture"
                              : "they explain the picture badly: name the lights yourself where you can";
}

}  // namespace

FrameLights lights_of_frame(const Scene& scene, int frame) {
    const FrameSurfaces seen = surfaces_of_frame(scene, frame);
    try {
        return {fit_lights(seen.surfaces), seen.albedo, seen.specular};
    } catch (const Error& error) { throw Error(fmt::format("{}: {}", seen.file, error.what())); }
}

bool wants_lights(const Scene& scene) {
    const Lighting& lighting = scene.lighting;
    if (lighting.relight != Relight::ratio) return false;
    const bool tables = scene::is_json(lighting.table_file) ||  // one may say that there are none
                        (lighting.table && !lighting.table->empty());
    if (tables) return false;
    if (lighting.lights.empty()) return lighting.ambient == Vec3{};
    const std::vector<Light> lamps = lamps_of(lighting);
    const auto known = [](const Light& l) {
        return (l.kind == LightKind::sun || l.kind == LightKind::point || l.kind == LightKind::sphere) && !l.range &&
               l.picture.empty() && l.diffuse.empty() && l.specular.empty();
    };
    return lighting.shadows == Shadows::automatic && !lamps.empty() && lamps.size() <= kMostNamed &&
           std::ranges::all_of(lamps, known);
}

FoundLights find_lights(const Scene& scene, int frame) {
    if (scene.lighting.lights.empty()) return {.all = lights_of_frame(scene, frame)};
    try {
        const FrameSurfaces seen = surfaces_of_frame(scene, frame, kSomeRows);
        const LightScale found = fit_scale(seen.surfaces, lamps_of(scene.lighting));
        if (!std::isfinite(found.scale) || !(found.scale > 0)) return {.why_not = "the scene's give no light"};
        if (!(found.apart < kAgree))
            return {.why_not = fmt::format("one of them is {:.2g} times as strong or weak beside the others as in the "
                                           "scene",
                                           found.apart)};
        if (found.median < kExplained && found.share > kLeastShare) return {.named = found};
        return {.why_not = fmt::format("of the picture's light they give {:.0f}%, and {:.0f}% are unexplained (median)",
                                       100 * found.share, 100 * found.median)};
    } catch (const Error& error) { return {.why_not = error.what()}; }
}

Scene with_lights(Scene scene, const FoundLights& found) {
    Lighting& lighting = scene.lighting;
    if (!found.all && !found.named) return scene;
    lighting.shadows = Shadows::read;
    if (found.all) {
        lighting.lights = found.all->fit.lights;
        return scene;
    }
    const bool sky = lighting.ambient != Vec3{} || lamps_of(lighting).size() < lighting.lights.size();
    for (Light& light : lighting.lights) light.intensity *= found.named->scale;
    for (double& part : lighting.ambient) part *= found.named->scale;
    if (!sky) lighting.lights.push_back(found.named->sky);
    return scene;
}

std::string summary(const FoundLights& found) {
    if (found.all) return "fitted to the picture as the scene names none: " + summary(*found.all);
    if (found.named)
        return fmt::format(
            "{:.3g} times the scene's in the picture's units, so their shadows are read off it "
            "({:.0f}% of the radiance unexplained, median; shadows = \"ignored\" does without)",
            found.named->scale, 100 * found.named->median);
    return "taken to reach every surface that faces them, as the picture does not tell how strong they are: " +
           found.why_not;
}

std::string summary(const FrameLights& lights) {
    const LightFit& fit = lights.fit;
    std::string lamps;
    for (std::size_t i = 1; i < fit.lights.size(); ++i) {
        const Light& light = fit.lights[i];
        const bool point = light.kind == LightKind::point;
        const Vec3& v = point ? light.position : light.direction;
        lamps +=
            fmt::format(", a {} [{:.2f}, {:.2f}, {:.2f}] with {:.3g} {}", point ? "point at" : "sun that travels along",
                        v[0], v[1], v[2], light.intensity, point ? "W/sr" : "W/m2");
    }
    return fmt::format("a sky{} ({:.0f}% of the radiance unexplained, median; 90%: {:.0f}%{}); {}", lamps,
                       100 * fit.median, 100 * fit.p90,
                       lights.albedo ? "" : "; the frame has no albedo, so colours of surfaces count as light's",
                       trust(fit));
}

std::string lights_as_toml(const FrameLights& lights) {
    const LightFit& fit = lights.fit;
    const auto vec = [](const Vec3& v) { return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", v[0], v[1], v[2]); };
    std::string text = fmt::format(
        "# Fitted by wrinkle to {} pixels: {}.\n"
        "# Unexplained: {:.1f}% of the radiance over the albedo (median), {:.0f}% (90%).{}\n"
        "# They are in the picture's units: set shadows = \"read\" in [lighting].\n",
        fit.surfaces, trust(fit), 100 * fit.median, 100 * fit.p90,
        lights.albedo ? "" : " Without an albedo, colours of surfaces count as light's.");
    for (std::size_t i = 0; i < fit.lights.size(); ++i) {
        const Light& light = fit.lights[i];
        text += "\n[[light]]\n";
        if (light.kind == LightKind::sky) {
            text += fmt::format("kind = \"sky\"\nup = {}\nzenith = {}\nhorizon = {}\nground = {}\n", vec(light.up),
                                vec(light.zenith), vec(light.horizon), vec(light.ground));
            continue;
        }
        const bool point = light.kind == LightKind::point;
        text += fmt::format("{} = {}  # to about {:.2g} {}; {:.0f}% of what faces it is in shadow\n",
                            point ? "kind = \"point\"\nposition" : "kind = \"sun\"\ndirection",
                            vec(point ? light.position : light.direction), fit.loose[i - 1],
                            point ? "metres" : "degrees", 100 * fit.shadowed[i - 1]);
        text += fmt::format("color = {}\nintensity = {:.4g}  # {}\n", vec(light.color), light.intensity,
                            point ? "W/sr" : "W/m2");
    }
    return text;
}

}  // namespace wrinkle
