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

/// Diffuse plus specular reflectance: albedo / pi + D G F / (4 nl nv). GGX D [Walter et al. 2007], alpha = roughness^2;
/// height-correlated Smith G [Heitz 2014]; Schlick F [1994]. Roughness is at least 0.03, nv = max(|n.v|, 1e-4).
template <class T>
Vec<T> brdf(Vec<T> n, Vec<T> v, Vec<T> l, const Surface<T>& s) {
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
    const T specular = nl > 0 ? d * g * f / (4 * nl * nv) : T(0);
    return s.albedo / pi + Vec<T>{specular, specular, specular};
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

/// albedo * ambient + sum over the lights of brdf * max(n.l, 0) * irradiance. v is unit, p is the world position.
template <class T>
Vec<T> lit(const Lighting& lighting, Vec<T> n, Vec<T> v, Vec<T> p, const Surface<T>& s) {
    const auto times = [](Vec<T> a, Vec<T> b) { return Vec<T>{a.x * b.x, a.y * b.y, a.z * b.z}; };
    Vec<T> sum = times(s.albedo, from_array<T>(lighting.ambient));
    for (const Light& light : lighting.lights) {
        const Arrival<T> a = arrival(light, p);
        const T nl = dot(n, a.direction);
        if (nl > 0) sum = sum + times(brdf(n, v, a.direction, s), a.irradiance) * nl;
    }
    return sum;
}

/// beauty * clamp((new + 1e-4) / (old + 1e-4), 1 / max_ratio, max_ratio), one channel.
template <class T>
T relight_ratio(T beauty, T lit_new, T lit_old, T max_ratio) {
    const T small = T(1) / 10000;
    return beauty * std::clamp((lit_new + small) / (lit_old + small), 1 / max_ratio, max_ratio);
}

}  // namespace wrinkle::reference
