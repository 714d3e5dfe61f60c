#include "resources/light_constants.h"

#include <algorithm>
#include <cmath>

#include "base/vec.h"
#include "scene/light_extent.h"
#include "scene/sky_axes.h"

namespace wrinkle {

namespace {

void put(double (&to)[3], const Vec3& from) { std::copy(from.begin(), from.end(), to); }

Vec3 scaled(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }

/// The kind of a light as kernels number it.
double kernel_kind(const Light& light) {
    switch (light.kind) {
        case LightKind::sun:
            return scene::has_extent(light) ? 3 : 0;
        case LightKind::spot:
            return 2;
        case LightKind::sphere:
            return scene::has_extent(light) ? 4 : 1;
        case LightKind::disc:
            return 5;
        case LightKind::rectangle:
            return 6;
        default:
            return 1;
    }
}

/// Sets what a light's kind makes of `shape`, and of `to_light` beside its direction.
void put_shape(wr_light& out, const Light& light) {
    const Vec3 back = scaled(normalize(light.direction), -1);
    switch (light.kind) {
        case LightKind::sun:
            out.shape[0] = std::tan(light.angle / 2);
            break;
        case LightKind::sphere:
            out.shape[0] = light.radius;
            break;
        case LightKind::disc: {
            const Vec3 any = std::abs(back[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
            put(out.shape, scaled(normalize(cross(any, back)), light.radius));
            put(out.to_light, scaled(back, light.radius));
            break;
        }
        case LightKind::rectangle:
            put(out.shape, scaled(normalize(cross(light.up, back)), light.size[0] / 2));
            put(out.to_light, scaled(back, light.size[1] / 2));
            break;
        default:
            out.shape[1] = std::cos(light.outer_angle);
            out.shape[0] = std::max(std::cos(light.inner_angle), out.shape[1] + 1e-6);
    }
}

}  // namespace

wr_light fill_light(const Light& light, const Vec3& eye) {
    wr_light out{};
    out.kind = kernel_kind(light);
    put(out.color, scaled(light.color, light.intensity));
    put(out.position, subtract(light.position, eye));
    put(out.to_light, scaled(normalize(light.direction), -1));
    put_shape(out, light);
    if (light.range) out.fade = 1 / (*light.range * *light.range);
    return out;
}

namespace {

/// Adds the irradiance / pi of two colours as coefficients of wr_sky's polynomials. Its radiance depends on the
/// elevation only, so the harmonics are zonal: c_l = (integral of radiance P_l over the sine) and the factors of a
/// clamped cosine [Ramamoorthi and Hanrahan 2001] make them c_0 / 2 + c_1 t + 5/8 c_2 P_2(t), t the cosine to the
/// zenith.
void add_sky_colours(double (&sky)[27], const Light& light) {
    const Vec3 up = normalize(light.up);
    for (std::size_t c = 0; c < 3; ++c) {
        const double horizon = light.horizon[c] * light.intensity, ground = light.ground[c] * light.intensity;
        const double rise = light.zenith[c] * light.intensity - horizon;
        const double once = horizon / 2 + rise / 3 - ground / 2, twice = 5.0 / 8 * rise / 8;
        const double terms[] = {(horizon + rise / 2 + ground) / 2,
                                once * up[0],
                                once * up[1],
                                once * up[2],
                                3 * twice * up[0] * up[1],
                                3 * twice * up[1] * up[2],
                                3 * twice * up[2] * up[0],
                                0.75 * twice * (up[0] * up[0] - up[1] * up[1]),
                                0.25 * twice * (3 * up[2] * up[2] - 1)};
        for (std::size_t k = 0; k < 9; ++k) sky[3 * k + c] += terms[k];
    }
}

/// Adds the irradiance / pi of a sky's picture. Its polynomials become those of world space: the linear ones a vector,
/// the quadratic ones a form without trace, in axes of which z is the sky's `up`.
void add_sky_picture(double (&sky)[27], const Light& light) {
    const scene::SkyAxes of_sky = scene::sky_axes(light);
    const std::array<Vec3, 3> axes{of_sky.ahead, of_sky.aside, of_sky.up};
    for (std::size_t c = 0; c < 3; ++c) {
        std::array<double, 9> k{};
        for (std::size_t i = 0; i < 9; ++i) k[i] = (*light.harmonics)[i][c] * light.intensity;
        const double form[3][3] = {
            {k[7] - k[8], k[4] / 2, k[6] / 2}, {k[4] / 2, -k[7] - k[8], k[5] / 2}, {k[6] / 2, k[5] / 2, 2 * k[8]}};
        const auto turned = [&](std::size_t i, std::size_t j) {
            double sum = 0;
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < 3; ++b) sum += axes[a][i] * form[a][b] * axes[b][j];
            return sum;
        };
        const auto linear = [&](std::size_t i) { return k[1] * axes[0][i] + k[2] * axes[1][i] + k[3] * axes[2][i]; };
        const double terms[] = {k[0],
                                linear(0),
                                linear(1),
                                linear(2),
                                2 * turned(0, 1),
                                2 * turned(1, 2),
                                2 * turned(2, 0),
                                (turned(0, 0) - turned(1, 1)) / 2,
                                turned(2, 2) / 2};
        for (std::size_t i = 0; i < 9; ++i) sky[3 * i + c] += terms[i];
    }
}

}  // namespace

void add_sky(double (&sky)[27], const Light& light) {
    light.harmonics ? add_sky_picture(sky, light) : add_sky_colours(sky, light);
}

}  // namespace wrinkle
