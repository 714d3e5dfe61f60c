#include "io/srgb_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace wrinkle::io {
namespace {

// A float's upper 16 bits number intervals so narrow, from 2^-13 on, that at most one step of the bytes lies in each.
constexpr std::uint32_t kShift = 16;
constexpr std::uint32_t kFirst = std::bit_cast<std::uint32_t>(0x1p-13f) >> kShift;
constexpr std::uint32_t kLast = std::bit_cast<std::uint32_t>(1.0f) >> kShift;

std::uint8_t rounded(float linear) {
    constexpr float most = 255;
    return static_cast<std::uint8_t>(std::min(srgb(linear) * most + 0.5f, most));
}

struct Table {
    Table() {
        for (std::uint32_t i = kFirst; i <= kLast; ++i) {
            const auto low = std::bit_cast<float>(i << kShift);
            least[i - kFirst] = rounded(low);
            // Positive floats are in the order of their bits.
            std::uint32_t below = i << kShift, above = (i + 1) << kShift;
            while (above - below > 1) {
                const std::uint32_t middle = below + (above - below) / 2;
                (rounded(std::bit_cast<float>(middle)) > least[i - kFirst] ? above : below) = middle;
            }
            step[i - kFirst] = std::bit_cast<float>(above);
        }
    }
    std::array<std::uint8_t, kLast - kFirst + 1> least{};
    std::array<float, kLast - kFirst + 1> step{};  ///< from where on it is one more
};

}  // namespace

float srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

std::uint8_t srgb_byte(float linear) {
    static const Table table;
    if (!(linear > 0x1p-13f)) return 0;  // also NaN
    if (linear >= 1) return std::numeric_limits<std::uint8_t>::max();
    const std::uint32_t i = (std::bit_cast<std::uint32_t>(linear) >> kShift) - kFirst;
    return static_cast<std::uint8_t>(table.least[i] + (linear >= table.step[i] ? 1 : 0));
}

}  // namespace wrinkle::io
