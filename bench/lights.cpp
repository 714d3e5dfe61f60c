#include "lights.h"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <random>

#include "resident.h"
#include "tests/reference/lighting.h"

namespace wrinkle::bench {

namespace {

constexpr std::size_t kLightSamples = 256;  // pixels whose light is summed up in double, over all lights
constexpr std::size_t kSpots = 4096;        // pixels at which lights are counted that reach them
constexpr double kReach = 8;                // lights that reach a pixel, on average
const std::filesystem::path kData = WRINKLE_SOURCE_DIR "/data";

using V = reference::Vec<double>;

/// Some of a frame's valid pixels.
struct Spot {
    std::size_t pixel;
    double depth;
    V point, normal;
};

std::vector<Spot> spots_of(const BenchFrame& frame, std::size_t count, unsigned seed) {
    const auto rays = *pinhole_rays(frame.frame.camera, frame.frame.size);
    const std::vector<float>& depth = frame.planes.at("depth");
    std::mt19937 random(seed);
    std::vector<Spot> spots;
    while (spots.size() < count) {
        const std::size_t i = random() % frame.pixels(), x = i % frame.frame.size.width, y = i / frame.frame.size.width;
        const double z = depth[i];
        if (!(z > 0 && z < 1e9)) continue;
        const auto part = [&](std::size_t k) {
            return rays.eye[k] + z * (rays.d0[k] + rays.dx[k] * (static_cast<double>(x) + 0.5) +
                                      rays.dy[k] * (static_cast<double>(y) + 0.5));
        };
        const auto normal = [&](const char* axis) { return double{frame.planes.at(std::string("normal.") + axis)[i]}; };
        spots.push_back({i, z, {part(0), part(1), part(2)}, {normal("x"), normal("y"), normal("z")}});
    }
    return spots;
}

/// Lights before some of the surfaces, with ranges of a share of their depth: as wide in the picture everywhere.
std::vector<Light> lights_at(const std::vector<Spot>& spots, double share) {
    std::vector<Light> lights;
    for (const Spot& spot : spots) {
        const double range = share * spot.depth;
        const V at = spot.point + spot.normal * (0.3 * range);
        lights.push_back(
            {.kind = LightKind::point, .intensity = range * range, .position = {at.x, at.y, at.z}, .range = range});
    }
    return lights;
}

double reaching(const std::vector<Light>& lights, const std::vector<Spot>& spots) {
    std::size_t count = 0;
    for (const Light& light : lights)
        for (const Spot& spot : spots)
            count += length(spot.point - reference::from_array<double>(light.position)) < *light.range ? 1 : 0;
    return static_cast<double>(count) / static_cast<double>(spots.size());
}

Scene scene_of(std::vector<Light> lights, bool table) {
    Scene scene;
    scene.lighting.relight = Relight::lit;
    scene.filter.taps = 1;
    if (table)
        scene.lighting.table = std::make_shared<const std::vector<Light>>(std::move(lights));
    else
        scene.lighting.lights = std::move(lights);
    return scene;
}

/// Relative errors of the light at some pixels, against the sum of all lights in double.
ErrorStats errors_of(Resident& resident, const Scene& scene, const BenchFrame& frame, const std::vector<Spot>& spots) {
    std::vector<std::vector<float>> lit;
    for (const char* name : {"lit.r", "lit.g", "lit.b"}) {
        std::vector<float>& plane = lit.emplace_back(frame.pixels());
        std::memcpy(plane.data(), resident.out.map<float>(name, CL_MAP_READ), plane.size() * sizeof(float));
    }
    resident.out.unmap();
    const auto eye = pinhole_rays(frame.frame.camera, frame.frame.size)->eye;
    std::vector<double> errors;
    for (const Spot& spot : spots) {
        const V n = normalize(spot.normal), v = normalize(V{eye[0], eye[1], eye[2]} - spot.point);
        const V base = dot(n, v) < 0 ? n - v * (2 * dot(n, v)) : n;
        const auto plane = [&](const char* name, double otherwise) {
            return frame.planes.contains(name) ? double{frame.planes.at(name)[spot.pixel]} : otherwise;
        };
        const Lighting& of = scene.lighting;
        const reference::Surface<double> surface{
            {plane("albedo.r", of.albedo[0]), plane("albedo.g", of.albedo[1]), plane("albedo.b", of.albedo[2])},
            plane("roughness", of.roughness),
            of.f0};
        const V want = reference::lit(of, base, v, spot.point, surface);
        const V got{lit[0][spot.pixel], lit[1][spot.pixel], lit[2][spot.pixel]};
        if (length(want) > 0) errors.push_back(length(got - want) / length(want));
    }
    return statistics(std::move(errors));
}

struct Entrant {
    std::string name;
    Scene scene;
    double reach;
    std::unique_ptr<Resident> resident;
};

Entrant prepare(const Device& device, const BenchFrame& frame, std::size_t count, const std::vector<Spot>& spots) {
    const std::vector<Spot> places = spots_of(frame, count, 5);
    double share = 0.5 * std::sqrt(kReach / static_cast<double>(count)), reach = 0;
    for (int round = 0; round < 6; ++round) {
        reach = reaching(lights_at(places, share), spots);
        if (std::abs(reach / kReach - 1) < 0.01) break;
        share *= std::sqrt(kReach / std::max(reach, 0.1));
    }
    Entrant e{fmt::format("{} lights", count), scene_of(lights_at(places, share), true), reach, nullptr};
    e.resident = std::make_unique<Resident>(device, e.scene, frame);
    return e;
}

}  // namespace

void measure_lights(const Device& device, Size size, bool quick, Run& run) {
    const BenchFrame frame = Resampler(load_scene(kData / "scenes/decals.toml")).frame(size);
    const std::vector<Spot> spots = spots_of(frame, kSpots, 3), samples = spots_of(frame, kLightSamples, 7);
    std::vector<Entrant> entrants;
    std::vector<Light> few = lights_at(spots_of(frame, 8, 4), 1);
    for (Light& light : few) light.range.reset();
    entrants.push_back({"8 lights everywhere", scene_of(few, false), 8, nullptr});
    entrants.back().resident = std::make_unique<Resident>(device, entrants.back().scene, frame);
    for (const std::size_t count : {1000, 10'000, 100'000})
        if (!quick || count < 100'000) entrants.push_back(prepare(device, frame, count, spots));
    std::vector<Contender> contenders;
    for (Entrant& e : entrants) contenders.push_back({"standard", [&] { e.resident->run(); }});
    race(contenders, run.rounds);
    for (std::size_t i = 0; i < entrants.size(); ++i) {
        Entrant& e = entrants[i];
        Measurement m = measured("lights", e.name, contenders[i], device.info.lanes, frame.pixels());
        m.bytes = bytes_of(e.resident->pass);
        m.operations = operations_of(e.resident->pass);
        m.at_most = true;
        m.unit = "relative";
        m.error = errors_of(*e.resident, e.scene, frame, samples);
        m.figures["lights a pixel"] = e.reach;
        run.measurements.push_back(std::move(m));
    }
}

}  // namespace wrinkle::bench
