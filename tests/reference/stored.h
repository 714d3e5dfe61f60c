#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "tests/reference/vec.h"
#include "wrinkle/plane_format.h"

/// Stored numbers, from the definitions of the formats: IEEE 754's binary16, normalised integers as Direct3D and Vulkan
/// have them, octahedral normals of [Cigolle et al. 2014].
namespace wrinkle::reference {

inline double from_half(std::uint32_t bits) {
    const double sign = (bits & 0x8000u) != 0 ? -1 : 1;
    const int exponent = static_cast<int>(bits >> 10 & 31u), fraction = static_cast<int>(bits & 1023u);
    if (exponent == 31) return fraction != 0 ? NAN : sign * INFINITY;
    return sign * (exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25));
}

inline std::uint32_t to_half(double v) {
    const std::uint32_t sign = std::signbit(v) ? 0x8000u : 0;
    if (std::isnan(v)) return 0x7e00u;
    if (std::abs(v) >= 65520) return sign | 0x7c00u;
    // Halves of one sign are in the order of their bits: the nearest is the one below, or the one after it.
    std::uint32_t below = 0;
    for (std::uint32_t bit = 0x4000u; bit != 0; bit >>= 1)
        if ((below | bit) < 0x7c00u && from_half(below | bit) <= std::abs(v)) below |= bit;
    const double next = below == 0x7bffu ? 65536 : from_half(below + 1), middle = (from_half(below) + next) / 2;
    const bool up = std::abs(v) > middle || (std::abs(v) == middle && below % 2 == 1);
    return sign | (below + (up ? 1 : 0));
}

/// The signed integer in the lower `count` bits.
inline double from_signed(std::uint32_t bits, int count) {
    const auto range = static_cast<double>(std::uint64_t{1} << count);
    const double v = bits & ((std::uint64_t{1} << count) - 1);
    return std::max(v < range / 2 ? v : v - range, 1 - range / 2);
}

inline Vec<double> from_octahedron(double u, double v) {
    const auto sign = [](double t) { return t < 0 ? -1.0 : 1.0; };
    const double z = 1 - std::abs(u) - std::abs(v);
    if (z >= 0) return normalize(Vec<double>{u, v, z});
    return normalize(Vec<double>{(1 - std::abs(v)) * sign(u), (1 - std::abs(u)) * sign(v), z});
}

/// The number that bits stand for, as a plane has it without scale and bias.
inline double decoded(PlaneEncoding encoding, std::uint32_t bits) {
    switch (encoding) {
        case PlaneEncoding::half:
            return from_half(bits);
        case PlaneEncoding::unorm8:
            return bits / 255.0;
        case PlaneEncoding::unorm16:
            return bits / 65535.0;
        case PlaneEncoding::snorm8:
            return from_signed(bits, 8) / 127.0;
        case PlaneEncoding::snorm16:
            return from_signed(bits, 16) / 32767.0;
        case PlaneEncoding::float32:
            break;
        default:
            return bits;
    }
    float v;
    std::memcpy(&v, &bits, sizeof v);
    return static_cast<double>(v);
}

inline Vec<double> decoded_normal(PlaneEncoding encoding, std::uint32_t bits) {
    const int count = encoding == PlaneEncoding::octahedral8 ? 8 : 16;
    const double most = std::ldexp(1, count - 1) - 1;
    return from_octahedron(from_signed(bits, count) / most, from_signed(bits >> count, count) / most);
}

/// The bits of the nearest number.
inline std::uint32_t encoded(PlaneEncoding encoding, double v) {
    const auto nearest = [v](double least, double most) {
        return static_cast<std::uint32_t>(
            static_cast<std::int64_t>(std::nearbyint(std::isnan(v) ? 0 : std::clamp(v * most, least * most, most))));
    };
    switch (encoding) {
        case PlaneEncoding::half:
            return to_half(v);
        case PlaneEncoding::unorm8:
            return nearest(0, 255);
        case PlaneEncoding::unorm16:
            return nearest(0, 65535);
        case PlaneEncoding::snorm8:
            return nearest(-1, 127) & 0xffu;
        case PlaneEncoding::snorm16:
            return nearest(-1, 32767) & 0xffffu;
        case PlaneEncoding::float32:
            break;
        default:
            return static_cast<std::uint32_t>(v);
    }
    const auto narrow = static_cast<float>(v);
    std::uint32_t bits;
    std::memcpy(&bits, &narrow, sizeof bits);
    return bits;
}

inline std::uint32_t encoded_normal(PlaneEncoding encoding, Vec<double> n) {
    const int count = encoding == PlaneEncoding::octahedral8 ? 8 : 16;
    const double most = std::ldexp(1, count - 1) - 1, size = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    double u = n.x / size, v = n.y / size;
    if (n.z < 0) {
        const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1), u = folded;
    }
    const auto bits = [&](double t) { return static_cast<std::uint32_t>(std::lround(t * most)) & ((1u << count) - 1); };
    return bits(u) | bits(v) << count;
}

/// Puts a stored number into pixel i of a memory.
inline void put(std::vector<std::byte>& memory, const PlaneFormat& format, std::size_t i, std::uint32_t bits) {
    const std::uint32_t bytes = bytes_of(format.encoding), stride = format.stride == 0 ? bytes : format.stride;
    std::memcpy(memory.data() + i * stride + format.offset, &bits, bytes);  // the lower bytes come first
}

inline std::uint32_t stored(const std::vector<std::byte>& memory, const PlaneFormat& format, std::size_t i) {
    const std::uint32_t bytes = bytes_of(format.encoding), stride = format.stride == 0 ? bytes : format.stride;
    std::uint32_t bits = 0;
    std::memcpy(&bits, memory.data() + i * stride + format.offset, bytes);
    return bits;
}

}  // namespace wrinkle::reference
