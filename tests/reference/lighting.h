#pragma once

#include "tests/reference/vec.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

template <class T>
Vec<T> from_array(const Vec3& a) {
    return {T(a[0]), T(a[1]), T(a[2])};
}

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

/// Direction to a light and the irradiance it gives at normal incidence, at world position p.
template <class T>
struct Arrival {
    Vec<T> direction, irradiance;
};

template <class T>
Arrival<T> arrival(const Light& light, Vec<T> p) {
    const Vec<T> power = from_array<T>(light.color) * T(light.intensity);
    const Vec<T> axis = normalize(from_array<T>(light.direction));
    if (light.kind == LightKind::sun) return {-axis, power};
    const Vec<T> to = from_array<T>(light.position) - p;
    const Vec<T> l = normalize(to);
    const T r2 = dot(to, to);
    if (!(r2 > 0)) return {};
    if (light.kind == LightKind::point) return {l, power / r2};
    const T outer = std::cos(T(light.outer_angle)), inner = std::cos(T(light.inner_angle)), c = -dot(l, axis);
    const T t = inner == outer ? T(c >= outer) : saturate((c - outer) / (inner - outer));
    return {l, power * (t * t * (3 - 2 * t) / r2)};
}

/// albedo * ambient + sum over the lights of (albedo / pi max(n.l, 0) + specular of the mirroring normal) * irradiance
/// * terminator. v is unit, p is the world position, base the normal of the surface that carries the bumps.
template <class T>
Vec<T> lit(const Lighting& lighting, Vec<T> n, Vec<T> base, Vec<T> v, Vec<T> p, const Surface<T>& s) {
    const auto times = [](Vec<T> a, Vec<T> b) { return Vec<T>{a.x * b.x, a.y * b.y, a.z * b.z}; };
    Vec<T> sum = times(s.albedo, from_array<T>(lighting.ambient));
    const Vec<T> mirror = mirror_normal(n, base, v);
    for (const Light& light : lighting.lights) {
        const Arrival<T> a = arrival(light, p);
        const T nl = std::max(dot(n, a.direction), T(0)), ml = std::max(dot(mirror, a.direction), T(0));
        const T specular = ml > 0 ? ml * mirrored(mirror, v, a.direction, s) : T(0);
        const Vec<T> reflected = s.albedo * (nl / std::numbers::pi_v<T>)+Vec<T>{specular, specular, specular};
        sum = sum + times(reflected, a.irradiance) * terminator(n, base, a.direction);
    }
    return sum;
}

/// The same of a surface without bumps.
template <class T>
Vec<T> lit(const Lighting& lighting, Vec<T> n, Vec<T> v, Vec<T> p, const Surface<T>& s) {
    return lit(lighting, n, n, v, p, s);
}

/// beauty * clamp((new + 1e-4) / (old + 1e-4), 1 / max_ratio, max_ratio), one channel.
template <class T>
T relight_ratio(T beauty, T lit_new, T lit_old, T max_ratio) {
    const T small = T(1) / 10000;
    return beauty * std::clamp((lit_new + small) / (lit_old + small), 1 / max_ratio, max_ratio);
}

}  // namespace wrinkle::reference
