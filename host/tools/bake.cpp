#include "tools/bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/imath.h"
#include "base/limits.h"
#include "wrinkle/error.h"
#include "wrinkle/functions.h"

namespace wrinkle {

namespace {

constexpr double kGoldenRadius = 5.3, kMarchRadius = 5.2;
/// Largest |gradient| of the golden-ratio function. Its value divided by this is no more than the distance to the
/// surface.
constexpr double kGoldenLipschitz = 6.2;

using Column = std::vector<double>;
using Imath::V3d;

/// Points, and what a function of points gives there.
struct Field {
    Column x, y, z;
    Column value, gx, gy, gz;

    std::size_t size() const { return x.size(); }
    void add(const V3d& p) { x.push_back(p.x), y.push_back(p.y), z.push_back(p.z); }
    void move(std::size_t i, const V3d& by) { x[i] += by.x, y[i] += by.y, z[i] += by.z; }
    V3d point(std::size_t i) const { return {x[i], y[i], z[i]}; }
    V3d gradient(std::size_t i) const { return {gx[i], gy[i], gz[i]}; }

    void evaluate(const Device& device, const char* name) {
        for (Column* c : {&value, &gx, &gy, &gz}) c->resize(size());
        evaluate_function(
            device, function(name), ColumnsInDouble{{"p.x", x}, {"p.y", y}, {"p.z", z}},
            ColumnResultsInDouble{{"value", value}, {"gradient.x", gx}, {"gradient.y", gy}, {"gradient.z", gz}});
    }
};

/// A cube of voxels whose indices are centred on the origin, or start there.
DenseVolume cube(int size, double voxel, bool centred) {
    DenseVolume volume;
    const int first = centred ? -size / 2 : 0;
    volume.first = {first, first, first}, volume.size = {size, size, size};
    for (std::size_t k = 0; k < 3; ++k) volume.world_from_index[k][k] = voxel;
    volume.world_from_index[3][3] = 1;
    return volume;
}

/// World positions of its voxels.
Field voxels_of(const DenseVolume& volume) {
    Field field;
    for (int z = 0; z < volume.size[2]; ++z)
        for (int y = 0; y < volume.size[1]; ++y)
            for (int x = 0; x < volume.size[0]; ++x)
                field.add({(volume.first[0] + x) * volume.world_from_index[0][0],
                           (volume.first[1] + y) * volume.world_from_index[1][1],
                           (volume.first[2] + z) * volume.world_from_index[2][2]});
    return field;
}

DenseVolume bake_noise(const Device& device, int size) {
    constexpr double kCells = 5, kOctaves = 3;  // cells along an edge in the first octave
    DenseVolume volume = cube(size, 1.0 / size, false);
    const Field points = voxels_of(volume);
    volume.values.assign(points.size(), 0);
    double frequency = kCells, amplitude = 1;
    for (int i = 0; i < kOctaves; ++i, frequency *= 2, amplitude /= 2) {
        Field lattice;
        for (std::size_t k = 0; k < points.size(); ++k) lattice.add(points.point(k) * frequency);
        lattice.evaluate(device, "perlin_noise");
        for (std::size_t k = 0; k < points.size(); ++k)
            volume.values[k] += static_cast<float>(amplitude * lattice.value[k]);
    }
    for (float& v : volume.values) v = std::clamp(v, 0.0f, 1.0f);
    return volume;
}

/// The points of the surface that are nearest to those given: each step goes along the gradient to where the surface
/// would be if the function were linear, and within that plane to the point nearest to the given one.
Field nearest(const Device& device, const Field& from) {
    Field to = from;
    for (int step = 0; step < 12; ++step) {
        to.evaluate(device, "golden_ratio");
        for (std::size_t i = 0; i < to.size(); ++i) {
            const V3d g = to.gradient(i), away = from.point(i) - to.point(i);
            const double square = std::max(g.length2(), 1e-3);
            to.move(i, away - g * ((g.dot(away) + to.value[i]) / square));
        }
    }
    return to;
}

DenseVolume bake_golden(const Device& device, int size) {
    const double voxel = 2 * kGoldenRadius / (size - 1);
    DenseVolume volume = cube(size, voxel, true);
    volume.grid = "golden";
    volume.level_set = true, volume.half = true;
    volume.background = static_cast<float>(3 * voxel);
    Field all = voxels_of(volume);
    all.evaluate(device, "golden_ratio");
    Field band;
    std::vector<std::size_t> places;
    volume.values.assign(all.size(), volume.background);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all.point(i).length() > kGoldenRadius) continue;
        if (all.value[i] < 0) volume.values[i] = -volume.background;
        if (std::abs(all.value[i]) >= kGoldenLipschitz * volume.background) continue;
        band.add(all.point(i));
        places.push_back(i);
    }
    const Field surface = nearest(device, band);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto distance = static_cast<float>((band.point(k) - surface.point(k)).length());
        float& v = volume.values[places[k]];
        v = std::copysign(std::min(distance, volume.background), v);
    }
    return volume;
}

DenseVolume bake_golden_gradient(const Device& device, int size) {
    DenseVolume volume = cube(size, 2 * kGoldenRadius / (size - 1), true);
    volume.grid = "gradient";
    volume.channels = 3, volume.half = true;
    Field all = voxels_of(volume);
    all.evaluate(device, "golden_ratio");
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const Column* c : {&all.gx, &all.gy, &all.gz}) volume.values.push_back(static_cast<float>((*c)[i]));
    return volume;
}

}  // namespace

DenseVolume bake_volume(const Device& device, BakedVolume kind, int size) {
    if (!device.info.fp64) throw Error("baking needs a device with double precision; see \"wrinkle devices\"");
    constexpr double bytes_of_voxel = 200;  // points, function values and gradients in double, of which some twice
    check_memory("bake-volume", bytes_of_voxel * std::pow(size, 3), fmt::format("a volume of {}^3 voxels", size));
    switch (kind) {
        case BakedVolume::noise:
            return bake_noise(device, size);
        case BakedVolume::golden:
            return bake_golden(device, size);
        case BakedVolume::golden_gradient:
            break;
    }
    return bake_golden_gradient(device, size);
}

std::map<std::string, std::vector<float>> bake_golden_rows(const Device& device, const Camera& camera, Size size,
                                                           std::uint32_t row_begin, std::uint32_t row_end) {
    if (!device.info.fp64) throw Error("baking needs a device with double precision; see \"wrinkle devices\"");
    const auto rays = pinhole_rays(camera, size);
    if (!rays) throw Error("a baked frame needs a pinhole camera");
    const std::size_t pixels = std::size_t{size.width} * (row_end - row_begin);
    const V3d viewer = to_imath(rays->eye), d0 = to_imath(rays->d0), dx = to_imath(rays->dx), dy = to_imath(rays->dy);
    Field directions;
    Column lengths, distance(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const double x = static_cast<double>(i % size.width) + 0.5,
                     y = row_begin + static_cast<double>(i / size.width) + 0.5;
        const V3d ray = d0 + x * dx + y * dy;
        lengths.push_back(ray.length());
        directions.add(direction(ray));
    }
    const Column eye[] = {Column(pixels, rays->eye[0]), Column(pixels, rays->eye[1]), Column(pixels, rays->eye[2])};
    evaluate_function(device, function("golden_march"),
                      ColumnsInDouble{{"eye.x", eye[0]},
                                      {"eye.y", eye[1]},
                                      {"eye.z", eye[2]},
                                      {"ray.x", directions.x},
                                      {"ray.y", directions.y},
                                      {"ray.z", directions.z}},
                      ColumnResultsInDouble{{"distance", distance}},
                      {.settings = {{"radius", std::vector<double>{kMarchRadius}}}});
    Field surface;
    for (std::size_t i = 0; i < pixels; ++i) surface.add(viewer + distance[i] * directions.point(i));
    surface.evaluate(device, "golden_ratio");
    std::map<std::string, std::vector<float>> planes;
    const auto put = [&](const char* name, double value) { planes[name].push_back(static_cast<float>(value)); };
    for (std::size_t i = 0; i < pixels; ++i) {
        const bool hit = distance[i] > 0;
        const V3d p = hit ? surface.point(i) : V3d(0), n = hit ? direction(surface.gradient(i)) : V3d(0);
        put("depth", hit ? distance[i] / lengths[i] : 1e10);
        put("position.x", p.x), put("position.y", p.y), put("position.z", p.z);
        put("normal.x", n.x), put("normal.y", n.y), put("normal.z", n.z);
    }
    return planes;
}

}  // namespace wrinkle
