#pragma once

#include <numbers>

#include "tests/reference/light_arrival.h"

namespace wrinkle::reference {

constexpr int area_steps = 32;  ///< of brute force over an area, one way; twice as many the other

/// Any two unit vectors across `n` and each other.
template <class T>
std::pair<Vec<T>, Vec<T>> across(Vec<T> n) {
    const Vec<T> x = normalize(cross(n, std::abs(n.x) < T(1) / 2 ? Vec<T>{1, 0, 0} : Vec<T>{0, 1, 0}));
    return {x, cross(n, x)};
}

/// Calls f(direction, solid angle) for directions all over a cone around `axis`, of the sine `sine` of its half angle.
template <class T, class F>
void over_cone(Vec<T> axis, T sine, const F& f, int steps) {
    const auto [x, y] = across(axis);
    const T low = std::sqrt(1 - sine * sine), rise = sine * sine / (1 + low);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            const T up = rise * (i + T(1) / 2) / steps, out = std::sqrt(up * (2 - up));
            const T turn = std::numbers::pi_v<T> * (j + i * T(0.618)) / steps;
            f(axis * (1 - up) + (x * std::cos(turn) + y * std::sin(turn)) * out,
              2 * std::numbers::pi_v<T> * rise / (2 * T(steps) * steps));
        }
}

/// Calls f(point, area) for points all over a disc or a rectangle.
template <class T, class F>
void over_shape(const Light& light, const F& f, int steps) {
    const Vec<T> axis = normalize(from_array<T>(light.direction)), middle = from_array<T>(light.position);
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < 2 * steps; ++j) {
            if (light.kind == LightKind::disc) {
                const auto [x, y] = across(axis);
                const T r = T(light.radius), out = r * std::sqrt((i + T(1) / 2) / steps);
                const T turn = std::numbers::pi_v<T> * (j + i * T(0.618)) / steps;
                f(middle + (x * std::cos(turn) + y * std::sin(turn)) * out,
                  std::numbers::pi_v<T> * r * r / (2 * T(steps) * steps));
            } else {
                const Vec<T> x = normalize(cross(from_array<T>(light.up), axis)), y = cross(axis, x);
                const T w = T(light.size[0]), h = T(light.size[1]);
                f(middle + x * (w * ((i + T(1) / 2) / steps - T(1) / 2)) +
                      y * (h * ((j + T(1) / 2) / (2 * steps) - T(1) / 2)),
                  w * h / (2 * T(steps) * steps));
            }
        }
}

/// Calls f(arrival) for the light that comes from a light's points: one, or brute force over what has an extent.
template <class T, class F>
void each_arrival(const Light& light, Vec<T> p, const F& f, int steps = area_steps) {
    constexpr T pi = std::numbers::pi_v<T>;
    const bool wide_sun = light.kind == LightKind::sun && light.angle > 0;
    const bool sphere = light.kind == LightKind::sphere && light.radius > 0;
    const bool flat = light.kind == LightKind::disc || light.kind == LightKind::rectangle;
    if (!wide_sun && !sphere && !flat) return f(arrival(light, p));
    const Vec<T> full = from_array<T>(light.color) * T(light.intensity);
    if (wide_sun) {
        const T sine = std::sin(T(light.angle) / 2);
        const auto add = [&](Vec<T> d, T angle) { f(Arrival<T>{d, full * (angle / (pi * sine * sine))}); };
        return over_cone(-normalize(from_array<T>(light.direction)), sine, add, steps);
    }
    const Vec<T> gap = from_array<T>(light.position) - p;
    const Vec<T> window = full * range_window(light.range, length(gap));
    if (sphere) {
        const T r = T(light.radius), sine = std::min(r / length(gap), T(0.9999));
        const auto add = [&](Vec<T> d, T angle) { f(Arrival<T>{d, window * (angle / (pi * r * r))}); };
        return over_cone(normalize(gap), sine, add, steps);
    }
    const bool disc = light.kind == LightKind::disc;
    const T area = disc ? pi * T(light.radius) * T(light.radius) : T(light.size[0]) * T(light.size[1]);
    const auto add = [&](Vec<T> from, T part) {
        const Vec<T> to = from - p;
        const T r2 = dot(to, to), facing = -dot(normalize(to), normalize(from_array<T>(light.direction)));
        if (facing > 0) f(Arrival<T>{normalize(to), window * (facing * part / (area * r2))});
    };
    over_shape<T>(light, add, steps);
}

}  // namespace wrinkle::reference
