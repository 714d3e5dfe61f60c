#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "wrinkle/camera.h"

/// The vectors of the shading language, as structs.
namespace wrinkle::baseline {

struct float2 {
    float x = 0, y = 0;
};
struct float3 {
    float x = 0, y = 0, z = 0;
};
struct float4 {
    float x = 0, y = 0, z = 0, w = 0;
};

inline float2 operator+(float2 a, float2 b) { return {a.x + b.x, a.y + b.y}; }
inline float2 operator-(float2 a, float2 b) { return {a.x - b.x, a.y - b.y}; }
inline float2 operator*(float s, float2 a) { return {s * a.x, s * a.y}; }
inline float dot(float2 a, float2 b) { return a.x * b.x + a.y * b.y; }

inline float3 operator+(float3 a, float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline float3 operator-(float3 a, float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline float3 operator*(float s, float3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline float3& operator+=(float3& a, float3 b) { return a = a + b; }
inline float dot(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float3 cross(float3 a, float3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline float3 normalize(float3 a) { return (1.0F / std::sqrt(dot(a, a))) * a; }

inline float4 operator+(float4 a, float4 b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
inline float4 operator*(float s, float4 a) { return {s * a.x, s * a.y, s * a.z, s * a.w}; }
inline float dot(float4 a, float4 b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }
inline float3 xyz(float4 a) { return {a.x, a.y, a.z}; }

template <class T>
T lerp(T a, T b, float t) {
    return a + t * (b - a);
}
inline float clamp01(float x) { return std::fmin(std::fmax(x, 0.0F), 1.0F); }

inline float3 to_float3(const Vec3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// -ffast-math assumes that NaN and Inf do not exist, so they are looked for in the bits.
inline bool finite(float x) { return (std::bit_cast<std::uint32_t>(x) & 0x7f800000U) != 0x7f800000U; }
inline bool finite(float3 v) { return finite(v.x) && finite(v.y) && finite(v.z); }
inline bool zero(float3 v) {
    return ((std::bit_cast<std::uint32_t>(v.x) | std::bit_cast<std::uint32_t>(v.y) | std::bit_cast<std::uint32_t>(v.z))
            << 1U) == 0;
}

}  // namespace wrinkle::baseline
