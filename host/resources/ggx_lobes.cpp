#include "resources/ggx_lobes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/vec.h"

#include "layout.h"

namespace wrinkle {

namespace {

/// A half vector at a quantile of GGX's normals, at an angle around the normal z.
Vec3 half_vector(double alpha, double quantile, double angle) {
    const double slope = alpha * std::sqrt(quantile / (1 - quantile)), z = 1 / std::sqrt(1 + slope * slope);
    return {slope * z * std::cos(angle), slope * z * std::sin(angle), z};
}

/// Smith's lambda.
double lambda(double cosine, double alpha) {
    return (std::sqrt(1 + alpha * alpha * (1 - cosine * cosine) / (cosine * cosine)) - 1) / 2;
}

Vec3 mirrored(const Vec3& view, const Vec3& half, double v_h) {
    return {2 * v_h * half[0] - view[0], 2 * v_h * half[1] - view[1], 2 * v_h * half[2] - view[2]};
}

/// Moments of one part of the reflectance, as a texel holds them.
struct Moments {
    double all = 0, less = 0, turn = 0;

    void add(double weight, double along, double aside) {
        all += weight, less += weight * (1 - along), turn += weight * aside;
    }
};

/// Those of both parts for a view whose cosine to the normal is `n_v`.
std::array<Moments, 2> moments_of(double n_v, double alpha) {
    constexpr int quantiles = 96, angles = 32;
    const double sine = std::sqrt(std::max(1 - n_v * n_v, 0.0));
    const Vec3 view{sine, 0, n_v}, ray{-sine, 0, n_v};
    std::array<Moments, 2> parts;
    for (int i = 0; i < quantiles; ++i)
        for (int j = 0; j < angles; ++j) {  // half way around: the other half is alike
            const Vec3 half = half_vector(alpha, (i + 0.5) / quantiles, (j + 0.5) * std::numbers::pi / angles);
            const double v_h = dot(view, half);
            const Vec3 light = mirrored(view, half, v_h);
            if (!(v_h > 0 && light[2] > 0)) continue;
            const double weight =
                v_h / (n_v * half[2]) / (1 + lambda(light[2], alpha) + lambda(n_v, alpha)) / (quantiles * angles);
            const double once = std::max(1 - v_h, 0.0), grazing = once * once * once * once * once;
            // The part of the direction across r, in the plane of n and r, is `aside` times that of n, which is the
            // sine.
            const double along = dot(light, ray), across = light[0] * n_v + light[2] * sine;
            const double aside = sine > 0 ? across / sine : 0;
            parts[0].add(weight * (1 - grazing), along, aside), parts[1].add(weight * grazing, along, aside);
        }
    return parts;
}

}  // namespace

std::vector<LobeSample> lobe_along_normal(double alpha, std::size_t count) {
    constexpr double turn = 2 * std::numbers::pi * 0.6180339887498949;  // the golden ratio spreads them evenly
    std::vector<LobeSample> samples;
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 half = half_vector(alpha, (static_cast<double>(k) + 0.5) / static_cast<double>(count),
                                      turn * static_cast<double>(k));
        const Vec3 light = mirrored({0, 0, 1}, half, half[2]);
        if (!(light[2] > 0)) continue;
        const double weight = 1 / (1 + lambda(light[2], alpha));
        const double q = half[2] * half[2] * (alpha * alpha - 1) + 1;
        const double density = alpha * alpha / (std::numbers::pi * q * q) / 4;  // of directions: D n.h / (4 v.h)
        samples.push_back({light, weight, 1 / (static_cast<double>(count) * density)});
        sum += weight;
    }
    for (LobeSample& sample : samples) sample.weight /= sum;
    return samples;
}

const std::vector<float>& ggx_lobes() {
    static const std::vector<float> table = [] {
        constexpr std::size_t size = WR_LOBE_SIZE, row = 2 * size * 3;
        std::vector<float> texels(row * size);
        for (std::size_t y = 0; y < size; ++y)
            for (std::size_t x = 0; x < size; ++x) {
                const double root = static_cast<double>(x) / (size - 1), n_v = std::clamp(root * root, 1e-4, 1 - 1e-6);
                const double roughness = std::max(static_cast<double>(y) / (size - 1), 0.03),
                             alpha = roughness * roughness;
                const auto parts = moments_of(n_v, alpha);
                for (std::size_t k = 0; k < 2; ++k) {
                    float* const texel = texels.data() + y * row + (k * size + x) * 3;
                    texel[0] = static_cast<float>(parts[k].all);
                    texel[1] = static_cast<float>(parts[k].less / alpha),
                    texel[2] = static_cast<float>(parts[k].turn / alpha);
                }
            }
        return texels;
    }();
    return table;
}

}  // namespace wrinkle
