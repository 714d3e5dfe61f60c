#pragma once

#include "tests/run/area_frames.h"

namespace wrinkle::test {

inline constexpr std::uint32_t kPoints = 16;  // along each side of a pixel

/// Of a pixel all of whose points lie on the surface.
struct Area {
    bool whole = true;
    V gradient, lit;
    double xx = 0, xy = 0, yy = 0;  ///< covariance along the image's axes on the surface
};

/// By the references, which evaluate layers without any filter at kPoints x kPoints points of every pixel.
inline std::vector<Area> brute_force(Scene scene) {
    for (Layer& layer : scene.layers) layer.footprint = false;
    const HostFrame fine = ground({kSize.width * kPoints, kSize.height * kPoints});
    const Truth truth(fine, scene);
    std::vector<Area> areas(std::size_t{kSize.width} * kSize.height);
    constexpr double share = 1.0 / (kPoints * kPoints);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const std::size_t x = i % fine.frame.size.width / kPoints, y = i / fine.frame.size.width / kPoints;
        Area& area = areas[y * kSize.width + x];
        const auto& point = truth.pixels[i];
        area.whole = area.whole && point.valid;
        if (!point.valid) continue;
        const V right = normalize(point.base.dp_dx), down = cross(right, point.base_normal), g = point.surface_gradient;
        area.gradient = area.gradient + g * share;
        area.xx += dot(g, right) * dot(g, right) * share, area.xy += dot(g, right) * dot(g, down) * share;
        area.yy += dot(g, down) * dot(g, down) * share;
        if (!truth.lit.empty()) area.lit = area.lit + truth.lit[i] * share;
    }
    for (Area& area : areas) {  // the ground's axes are those of its frame everywhere
        area.xx -= area.gradient.x * area.gradient.x, area.yy -= area.gradient.y * area.gradient.y;
        area.xy += area.gradient.x * area.gradient.y;
    }
    return areas;
}

inline V normal_of(V gradient) { return normalize(V{0, 0, 1} - gradient); }

/// The angles between the normals of a run and those of the areas.
inline Spread errors(const Pixels& got, const std::vector<Area>& areas) {
    std::vector<double> all;
    for (std::size_t i = 0; i < areas.size(); ++i)
        if (areas[i].whole) all.push_back(angle_degrees(vec_at(got, "normal", i), normal_of(areas[i].gradient)));
    return Spread(all);
}

/// Root of the sum of both variances, over all whole pixels.
inline double sigma(const std::vector<Area>& areas) {
    double sum = 0;
    for (const Area& area : areas)
        if (area.whole) sum += area.xx + area.yy;
    return std::sqrt(sum);
}

}  // namespace wrinkle::test
