#include "io/object_ids.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

namespace wrinkle::io {
namespace {

constexpr std::uint32_t kExact = 1u << 24;  // floats hold every whole number up to here
constexpr std::uint32_t kExponentBit = 1u << 23;

/// As Cryptomatte does: a bit of the exponent is flipped where the float would be zero, denormal, Inf or NaN.
std::uint32_t normal_bits(std::uint32_t bits) {
    const std::uint32_t exponent = bits >> 23 & 255;
    return exponent == 0 || exponent == 255 ? bits ^ kExponentBit : bits;
}

float label_of(std::uint32_t number) {
    return number <= kExact ? static_cast<float>(number) : std::bit_cast<float>(normal_bits(number));
}

bool is_whole(double number) { return number == std::floor(number); }

/// The whole number that a float is so near to that it must be meant; else the float itself. Filtered object numbers
/// are sums of weights, off by a few roundings in the last of 24 bits.
float rounded(float value) {
    constexpr float share = 1e-6f, least = 1e-3f;
    const float near = std::nearbyint(value);
    return std::abs(value - near) <= std::max(least, share * std::abs(value)) ? near : value;
}

}  // namespace

float object_label(double number) {
    const bool has_32_bits = number > kExact && number <= static_cast<double>(UINT32_MAX) && is_whole(number);
    return has_32_bits ? label_of(static_cast<std::uint32_t>(number)) : static_cast<float>(number);
}

double object_number(float label) {
    const bool itself = std::abs(label) <= static_cast<float>(kExact) && is_whole(label);
    if (itself) return label;
    const auto bits = std::bit_cast<std::uint32_t>(label);
    // A label whose exponent is 1 or 254 may be a number as it is, or one whose exponent bit was flipped to make it a
    // normal float. The latter is taken, as the likelier one.
    const std::uint32_t exponent = bits >> 23 & 255;
    return exponent == 1 || exponent == 254 ? bits ^ kExponentBit : bits;
}

bool is_mixed_object(float stored) { return std::isfinite(stored) && !is_whole(rounded(stored)); }

ObjectStorage object_storage(std::span<const float> sample) {
    constexpr std::size_t few = 16, repeats = 20, often = 8;
    constexpr float least = 1e-3f, most = 4.3e9f;  // numbers of objects lie between; bits of 32 seldom do
    std::size_t shown = 0, mixed = 0;
    std::set<float> different;
    std::map<float, std::size_t> outside;
    for (const float value : sample) {
        if (!std::isfinite(value) || value == 0) continue;
        if (!std::isnormal(value)) return ObjectStorage::bits;
        // Filters leave such shares of a number too, but no two of them alike.
        if ((std::abs(value) < least || std::abs(value) > most) && ++outside[value] == often)
            return ObjectStorage::bits;
        ++shown;
        if (!is_mixed_object(value)) continue;
        ++mixed;
        different.insert(value);
    }
    const bool bits = 2 * mixed > shown && different.size() <= std::max(few, mixed / repeats);
    return bits ? ObjectStorage::bits : ObjectStorage::single;
}

void label_objects(std::span<float> values, ObjectStorage storage) {
    for (float& value : values) {
        if (storage != ObjectStorage::single)
            value = label_of(std::bit_cast<std::uint32_t>(value));
        else if (std::isfinite(value))
            value = object_label(rounded(value));
    }
}

}  // namespace wrinkle::io
