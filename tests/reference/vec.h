#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

/// Reference implementations: written from the papers, never from the kernels, in long double (or any T).
/// [Mik20] = Mikkelsen, "Surface Gradient-Based Bump Mapping Framework", JCGT 9(3), 2020.
namespace wrinkle::reference {

using real = long double;

template <class T>
struct Vec2 {
    T x{}, y{};
};

template <class T>
struct Vec {
    T x{}, y{}, z{};
};

template <class T>
Vec2<T> operator+(Vec2<T> a, Vec2<T> b) {
    return {a.x + b.x, a.y + b.y};
}
template <class T>
Vec2<T> operator-(Vec2<T> a, Vec2<T> b) {
    return {a.x - b.x, a.y - b.y};
}
template <class T>
Vec2<T> operator*(Vec2<T> a, T s) {
    return {a.x * s, a.y * s};
}
template <class T>
Vec2<T> operator*(T s, Vec2<T> a) {
    return a * s;
}
template <class T>
T dot(Vec2<T> a, Vec2<T> b) {
    return a.x * b.x + a.y * b.y;
}
template <class T>
bool finite(Vec2<T> a) {
    return std::isfinite(a.x) && std::isfinite(a.y);
}

template <class T>
Vec<T> operator+(Vec<T> a, Vec<T> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vec<T> operator-(Vec<T> a, Vec<T> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vec<T> operator-(Vec<T> a) {
    return {-a.x, -a.y, -a.z};
}
template <class T>
Vec<T> operator*(Vec<T> a, T s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class T>
Vec<T> operator*(T s, Vec<T> a) {
    return a * s;
}
template <class T>
Vec<T> operator/(Vec<T> a, T s) {
    return {a.x / s, a.y / s, a.z / s};
}
template <class T>
T dot(Vec<T> a, Vec<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
Vec<T> cross(Vec<T> a, Vec<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
bool finite(Vec<T> a) {
    return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
template <class T>
bool is_zero(Vec<T> a) {
    return a.x == 0 && a.y == 0 && a.z == 0;
}
template <class T>
T largest(Vec<T> a) {
    return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)});
}

/// std::hypot: no overflow or underflow on the way.
template <class T>
T length(Vec<T> a) {
    return std::hypot(a.x, a.y, a.z);
}

/// The unit vector; zero stays zero.
template <class T>
Vec<T> normalize(Vec<T> a) {
    const T m = largest(a);
    if (!(m > 0)) return a;
    const Vec<T> b = a / m;
    return b / std::sqrt(dot(b, b));
}

/// The angle between two directions, in degrees. By atan2, since acos loses digits near 0 and 180.
template <class T>
T angle_degrees(Vec<T> a, Vec<T> b) {
    const Vec<T> u = normalize(a), v = normalize(b);
    return std::atan2(length(cross(u, v)), dot(u, v)) * T(180) / std::numbers::pi_v<T>;
}

/// |a - want| / |want|, or |a| when want is zero.
template <class T>
T relative_error(Vec<T> a, Vec<T> want) {
    const T size = length(want);
    return length(a - want) / (size > 0 ? size : T(1));
}
template <class T>
T relative_error(Vec2<T> a, Vec2<T> want) {
    return relative_error(Vec<T>{a.x, a.y, 0}, Vec<T>{want.x, want.y, 0});
}

template <class T>
T saturate(T a) {
    return std::fmin(std::fmax(a, T(0)), T(1));
}  ///< NaN gives 0

}  // namespace wrinkle::reference
