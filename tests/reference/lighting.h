#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "tests/reference/area_light.h"
#include "tests/reference/vec.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

template <class T>
struct Surface {
    Vec<T> albedo;
    T roughness{}, f0{};
};

/// Specular reflectance D G F / (4 nl nv). GGX D [Walter et al. 2007], alpha = roughness^2; height-correlated Smith G
/// [Heitz 2014]; Schlick F [1994]. Roughness is at least 0.03, nv = max(|n.v|, 1e-4).
template <class T>
T mirrored(Vec<T> n, Vec<T> v, Vec<T> l, const Surface<T>& s) {
    constexpr T pi = std::numbers::pi_v<T>;
    const Vec<T> h = normalize(v + l);
    const T nl = std::max(dot(n, l), T(0)), nv = std::max(std::abs(dot(n, v)), T(1) / 10000);
    const T nh = dot(n, h), vh = dot(v, h);
    const T roughness = std::max(s.roughness, T(3) / 100), alpha = roughness * roughness, a2 = alpha * alpha;
    const T q = nh * nh * (a2 - 1) + 1;
    const T d = a2 / (pi * q * q);
    const auto lambda = [&](T c) { return (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1) / 2; };
    const T g = nl > 0 ? 1 / (1 + lambda(nl) + lambda(nv)) : T(0);
    const T f = s.f0 + (1 - s.f0) * std::pow(1 - saturate(vh), T(5));
    return nl > 0 ? d * g * f / (4 * nl * nv) : T(0);
}

/// Diffuse plus specular reflectance of a surface without bumps.
template <class T>
Vec<T> brdf(Vec<T> n, Vec<T> v, Vec<T> l, const Surface<T>& s) {
    const T specular = mirrored(n, v, l, s);
    return s.albedo / std::numbers::pi_v<T> + Vec<T>{specular, specular, specular};
}

/// The normal that mirrors: n, or, where the viewer's reflection would rise above the base surface by less than 0.01 or
/// than 0.9 of what the view does, the normal on the way from n to base whose reflection rises by just that. In the
/// plane of base and n at an angle a from base, the reflection rises by |v'| cos(2 a - b), where v' is the view in that
/// plane and b its angle from base.
template <class T>
Vec<T> mirror_normal(Vec<T> n, Vec<T> base, Vec<T> v) {
    const T rise = std::max(dot(v, base), T(0)), least = std::min(rise * 9 / 10, T(1) / 100);
    if (2 * dot(n, v) * dot(n, base) - rise >= least) return n;
    const Vec<T> aside = normalize(n - base * dot(n, base));
    const T along = dot(v, aside), size = std::hypot(along, rise);
    if (!(size > 0)) return base;
    const T angle = (std::atan2(along, rise) + std::acos(std::clamp(least / size, T(-1), T(1)))) / 2;
    return base * std::cos(angle) + aside * std::sin(angle);
}

/// Share of a light that a bumped surface keeps by the terminator of its base [Chiang et al. 2019].
template <class T>
T terminator(Vec<T> n, Vec<T> base, Vec<T> l) {
    if (!(dot(base, l) > 0)) return 0;
    const T below = std::max(dot(n, l), T(0)) * std::max(dot(n, base), T(0));
    const T g = below > dot(base, l) ? dot(base, l) / below : T(1);
    return -g * g * g + g * g + g;
}

/// Share of light from all around that a bumped surface keeps: the base hides (1 - n.base) / 2 of it, and 0.55 of what
/// the terminator takes beyond that, as a fit gives it (lighting_test.cpp has the integral).
template <class T>
T sky_keeps(Vec<T> n, Vec<T> base) {
    const T apart = length(n - base), square = apart * apart / 2, s = std::sqrt(square);
    if (square >= 1) return (1 + dot(n, base)) / 2;
    const T faded = square * (T(0.698L) - T(0.296L) * s + T(0.1565L) * square) / (T(0.117L) + s);
    return 1 - T(0.45L) * square / 2 - T(0.55L) * faded;
}

/// The pictures that show what of a light is diffuse, and what is specular; "": none does.
inline const std::string& diffuse_picture(const Light& light) {
    return light.diffuse.empty() ? light.picture : light.diffuse;
}
inline const std::string& specular_picture(const Light& light) {
    return light.specular.empty() ? light.picture : light.specular;
}

/// The different pictures of lights, and "".
inline std::set<std::string> pictures(const Lighting& lighting) {
    std::set<std::string> all{""};
    for (const Light& light : lighting.lights) all.insert({diffuse_picture(light), specular_picture(light)});
    return all;
}

/// Radiance of a sky from the direction d.
template <class T>
Vec<T> sky_radiance(const Light& sky, Vec<T> d) {
    const T sine = dot(d, normalize(from_array<T>(sky.up))), intensity = sky.intensity;
    if (sine < 0) return from_array<T>(sky.ground) * intensity;
    return (from_array<T>(sky.horizon) * (1 - sine) + from_array<T>(sky.zenith) * sine) * intensity;
}

/// Irradiance / pi of the sky on a surface with the normal n: its radiance projected onto real spherical harmonics of
/// order 2, each times its factor of the clamped cosine, pi, 2 pi / 3 and pi / 4 [Ramamoorthi and Hanrahan 2001]; and
/// of that sky_keeps(). The projection is a sum that is
/// exact for radiance which is linear in the sine of the elevation, above the horizon and below.
template <class T>
Vec<T> sky_light(const Lighting& lighting, Vec<T> n, Vec<T> base) {
    constexpr T pi = std::numbers::pi_v<T>;
    const auto harmonics = [&](Vec<T> d) {
        const T one = std::sqrt(3 / (4 * pi)), two = std::sqrt(15 / (4 * pi));
        return std::array<T, 9>{std::sqrt(1 / (4 * pi)),
                                one * d.x,
                                one * d.y,
                                one * d.z,
                                two * d.x * d.y,
                                two * d.y * d.z,
                                two * d.z * d.x,
                                two / 2 * (d.x * d.x - d.y * d.y),
                                std::sqrt(5 / (16 * pi)) * (3 * d.z * d.z - 1)};
    };
    Vec<T> sum = from_array<T>(lighting.ambient);
    const std::array<T, 9> of_normal = harmonics(n);
    for (const Light& light : lighting.lights) {
        if (light.kind != LightKind::sky) continue;
        const Vec<T> up = normalize(from_array<T>(light.up));
        const Vec<T> x = normalize(cross(up, std::abs(up.x) < T(1) / 2 ? Vec<T>{1, 0, 0} : Vec<T>{0, 1, 0}));
        const Vec<T> y = cross(up, x);
        const T node = std::sqrt(T(3) / 5) / 2;  // Gauss and Legendre, three points
        const std::pair<T, T> nodes[] = {
            {T(1) / 2 - node, T(5) / 18}, {T(1) / 2, T(4) / 9}, {T(1) / 2 + node, T(5) / 18}};
        constexpr int turns = 8;
        for (const auto& [at, weight] : nodes)
            for (const int side : {-1, 1})
                for (int turn = 0; turn < turns; ++turn) {
                    const T sine = side * at, cosine = std::sqrt(1 - sine * sine), angle = 2 * pi * turn / turns;
                    const Vec<T> d = up * sine + (x * std::cos(angle) + y * std::sin(angle)) * cosine;
                    const std::array<T, 9> of_sky = harmonics(d);
                    T kernel = of_sky[0] * of_normal[0];
                    for (int k = 1; k < 9; ++k) kernel += of_sky[k] * of_normal[k] * (k < 4 ? T(2) / 3 : T(1) / 4);
                    sum = sum + sky_radiance(light, d) * (kernel * weight * 2 * pi / turns);
                }
    }
    return sum * sky_keeps(n, base);
}

/// What of lights one picture shows (of "": what none does): the sums of albedo / pi max(n.l, 0) and of the specular
/// of the mirroring normal, each * irradiance * terminator.
template <class T>
struct Lobes {
    Vec<T> diffuse, specular;
};
template <class T>
Lobes<T> lobes_by(const std::string& picture, const Lighting& lighting, Vec<T> n, Vec<T> base, Vec<T> v, Vec<T> p,
                  const Surface<T>& s) {
    const auto times = [](Vec<T> a, Vec<T> b) { return Vec<T>{a.x * b.x, a.y * b.y, a.z * b.z}; };
    Lobes<T> sum;
    const Vec<T> mirror = mirror_normal(n, base, v);
    const auto add = [&](const Light& light) {
        if (light.kind == LightKind::sky) return;
        each_arrival(light, p, [&](const Arrival<T>& a) {
            const T nl = std::max(dot(n, a.direction), T(0)), ml = std::max(dot(mirror, a.direction), T(0));
            const T specular = ml > 0 ? ml * mirrored(mirror, v, a.direction, s) : T(0);
            const Vec<T> arrives = a.irradiance * terminator(n, base, a.direction);
            if (diffuse_picture(light) == picture)
                sum.diffuse = sum.diffuse + times(s.albedo * (nl / std::numbers::pi_v<T>), arrives);
            if (specular_picture(light) == picture) sum.specular = sum.specular + arrives * specular;
        });
    };
    std::ranges::for_each(lighting.lights, add);
    if (lighting.table) std::ranges::for_each(*lighting.table, add);
    return sum;
}

/// Both together.
template <class T>
Vec<T> lit_by(const std::string& picture, const Lighting& lighting, Vec<T> n, Vec<T> base, Vec<T> v, Vec<T> p,
              const Surface<T>& s) {
    const Lobes<T> both = lobes_by(picture, lighting, n, base, v, p, s);
    return both.diffuse + both.specular;
}

/// albedo * sky + all lights. v is unit, p is the world position, base the normal of the surface that carries the
/// bumps.
template <class T>
Vec<T> lit(const Lighting& lighting, Vec<T> n, Vec<T> base, Vec<T> v, Vec<T> p, const Surface<T>& s) {
    const auto times = [](Vec<T> a, Vec<T> b) { return Vec<T>{a.x * b.x, a.y * b.y, a.z * b.z}; };
    Vec<T> sum = times(s.albedo, sky_light(lighting, n, base));
    for (const std::string& picture : pictures(lighting)) sum = sum + lit_by(picture, lighting, n, base, v, p, s);
    return sum;
}

/// The same of a surface without bumps.
template <class T>
Vec<T> lit(const Lighting& lighting, Vec<T> n, Vec<T> v, Vec<T> p, const Surface<T>& s) {
    return lit(lighting, n, n, v, p, s);
}

}  // namespace wrinkle::reference
