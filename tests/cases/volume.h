#pragma once

#include <limits>

#include "resources/volume_heap.h"
#include "tests/cases/cases.h"
#include "tests/reference/volume.h"

namespace wrinkle::cases {

/// A grid of 5 x 4 x 3 blocks that does not begin at 0: most blocks hold random voxels, some a single value, some are
/// background.
inline Volume made_volume(int channels) {
    Random random(11);
    Volume volume;
    volume.info.channels = channels;
    volume.first = {-3, -1, 2};
    volume.count = {5, 4, 3};
    volume.constants = {0.25f, 0.25f, 0.25f, -0.5f, 0.75f, -1, 0.875f, 0, 1};
    for (int i = 0; i < 5 * 4 * 3; ++i) {
        if (i % 3 == 1) {
            volume.blocks.push_back(-1 - i % 4 % 3);
            continue;
        }
        volume.blocks.push_back(static_cast<std::int32_t>(volume.voxels.size() /
                                                          (Volume::block_voxels * static_cast<std::size_t>(channels))));
        for (std::size_t k = 0; k < Volume::block_voxels * static_cast<std::size_t>(channels); ++k)
            volume.voxels.push_back(static_cast<float>(random.uniform(-1, 1)));
    }
    return volume;
}

/// Points within cells, on their faces, edges and corners, at borders of blocks, at the border of the grid and far from
/// it.
inline std::vector<V> volume_points() {
    std::vector<V> points;
    for (unsigned seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        V p{random.uniform(-34, 26), random.uniform(-18, 34), random.uniform(6, 50)};
        if (seed % 5 == 0) p.x = std::floor(p.x);
        if (seed % 7 == 0) p.y = 8 * std::floor(p.y / 8) + random.uniform(-1, 1);
        if (seed % 11 == 0) p.z = std::floor(p.z) + 0.5L;
        if (seed % 13 == 0) p = random.box(1) * random.magnitude(2, 30);
        if (seed % 17 == 0) p = {std::floor(p.x), std::floor(p.y), std::floor(p.z)};
        if (seed % 19 == 0) p.z = -1e-30L;
        points.push_back(Random::rounded(p));
    }
    return points;
}

inline Cases volume_cases(TexelKind kind) {
    Cases c{.name = kind == TexelKind::volume ? "trilinear volume" : "B-spline volume"};
    const Volume volume = made_volume(1);
    TextureHeap heap;
    add_volume(heap, volume, kind);
    heap.texels.resize(heap.texels.size() + 4);
    c.data.texels = heap.texels, c.data.textures = heap.table;
    c.data.constants = {0};
    const reference::Voxels<real> voxel = [&](int x, int y, int z) { return real{volume.at(x, y, z, 0)}; };
    for (const V& p : volume_points()) {
        const bool far = largest(p) > 1000;
        c.add("volume at " + std::to_string(double(p.x)) + ", " + std::to_string(double(p.y)), far);
        c.in("p", p);
        const auto want = far                         ? reference::NoiseValue<real>{0.25L, {}}
                          : kind == TexelKind::volume ? reference::trilinear(voxel, p)
                                                      : reference::quadratic_spline(voxel, p);
        c.out("value", want.value), c.out("gradient", want.gradient);
    }
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const V& p : {V{inf, 0, 0}, V{0, -inf, 20}, V{nan, nan, nan}}) {
        c.add("volume at no point", true);
        c.in("p", p);
        c.out("value", real{0.25L}), c.out("gradient", V{});
    }
    return c;
}

inline Cases volume_vector_cases() {
    Cases c{.name = "volume of vectors"};
    const Volume volume = made_volume(3);
    TextureHeap heap;
    add_volume(heap, volume, TexelKind::volume);
    heap.texels.resize(heap.texels.size() + 4);
    c.data.texels = heap.texels, c.data.textures = heap.table;
    c.data.constants = {0};
    const auto part = [&](int channel, V p) {
        return reference::trilinear<real>([&](int x, int y, int z) { return real{volume.at(x, y, z, channel)}; }, p)
            .value;
    };
    for (const V& p : volume_points()) {
        if (largest(p) > 1000) continue;
        c.add("vectors at " + std::to_string(double(p.x)) + ", " + std::to_string(double(p.y)), false);
        c.in("p", p);
        c.out("v", V{part(0, p), part(1, p), part(2, p)});
    }
    return c;
}

inline Cases golden_ratio_cases() {
    Cases c{.name = "golden-ratio surface"};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const V p = random.box(seed % 3 == 0 ? 1e-3L : 5.5L);
        c.add("golden ratio, seed " + std::to_string(seed), false);
        c.in("p", p);
        const auto want = reference::golden_ratio(p);
        c.out("value", want.value), c.out("gradient", want.gradient);
    }
    return c;
}

inline Cases golden_march_cases() {
    constexpr real radius = 5.2L;
    Cases c{.name = "march to the golden-ratio surface"};
    c.data.constants = {5.2};
    for (unsigned seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const V eye = Random::rounded(random.unit() * random.uniform(7, 15));
        const V ray = Random::rounded(normalize(random.box(seed % 4 ? 3 : 20) - eye));
        const real want = reference::golden_distance(eye, ray, radius);
        const auto f = reference::golden_ratio(eye + ray * want);
        const real cosine = std::abs(dot(normalize(f.gradient), ray));
        if (want > 0 && cosine < 0.02L) continue;  // so grazing that rounding decides between hit and miss
        c.add("march, seed " + std::to_string(seed), false, want > 0 ? 1 / cosine : 1);
        c.in("eye", eye), c.in("ray", ray);
        c.out("distance", want);
    }
    return c;
}

}  // namespace wrinkle::cases
