#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/reference/vec.h"

namespace wrinkle::reference {

/// MurmurHash3_x86_32 (A. Appleby, public domain), seed 0.
inline std::uint32_t murmur3_32(std::string_view text) {
    const auto byte = [&](std::size_t i) { return std::uint32_t{static_cast<unsigned char>(text[i])}; };
    const auto scramble = [](std::uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; };
    std::uint32_t h = 0;
    const std::size_t blocks = text.size() / 4 * 4;
    for (std::size_t i = 0; i < blocks; i += 4) {
        h ^= scramble(byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24);
        h = std::rotl(h, 13) * 5 + 0xe6546b64u;
    }
    std::uint32_t tail = 0;
    for (std::size_t i = text.size(); i-- > blocks;) tail = tail << 8 | byte(i);
    if (text.size() > blocks) h ^= scramble(tail);
    h ^= static_cast<std::uint32_t>(text.size());
    h = (h ^ h >> 16) * 0x85ebca6bu;
    h = (h ^ h >> 13) * 0xc2b2ae35u;
    return h ^ h >> 16;
}

/// Cryptomatte specification 1.2: the hash of a name, as the bits of a float. When the exponent's bits are all equal
/// (zero, denormal, infinite, NaN), the lowest of them is flipped. "#" and 8 hex digits are the bits themselves.
inline std::uint32_t cryptomatte_bits(const std::string& name) {
    if (name.size() == 9 && name[0] == '#') return static_cast<std::uint32_t>(std::stoul(name.substr(1), nullptr, 16));
    const std::uint32_t hash = murmur3_32(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

/// The sum of the coverages of those ranks (id, coverage) of a pixel whose id is `bits`.
template <class T>
T cryptomatte_coverage(std::span<const std::pair<float, float>> ranks, std::uint32_t bits) {
    T sum = 0;
    for (const auto& [id, coverage] : ranks)
        if (std::bit_cast<std::uint32_t>(id) == bits) sum += coverage;
    return sum;
}

/// The coverage that bumps keep of it: all where one of `names` is in front, none behind another. An id of either zero
/// says that nobody knows: then those keep it who cover all but 2 % of the pixel. `others`: what the bumps of all other
/// objects lose by them.
template <class T>
T coverage_of_bumps(T covered, std::uint32_t front, const std::vector<std::string>& names, bool others) {
    bool named = false;
    for (const std::string& name : names) named = named || cryptomatte_bits(name) == front;
    const bool nobody_knows = front == 0 || front == 0x80000000u;
    if (others && !named && !(nobody_knows && covered > T(2) / 100)) return covered;
    if (others) return 1;
    return named || (nobody_knows && covered > T(98) / 100) ? covered : T(0);
}

}  // namespace wrinkle::reference
