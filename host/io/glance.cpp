#include "io/glance.h"

#include <algorithm>

namespace wrinkle::io {

std::uint32_t blocks_at_a_glance(std::span<const Part> parts, std::uint32_t most) {
    constexpr double bytes = 64e6, fewest = 3;  // a tenth of a second
    const double largest = std::ranges::max_element(parts, {}, &Part::block_bytes)->block_bytes;
    const auto affordable = static_cast<std::uint32_t>(std::clamp(bytes / std::max(largest, 1.0), fewest, 1e9));
    return std::min(affordable - (affordable + 1) % 2, most);  // an odd number has the middle row, whoever asks
}

std::vector<std::uint32_t> glance_rows(std::span<const Part> parts, std::uint32_t height) {
    constexpr std::uint32_t most = 9;
    const std::uint32_t count = blocks_at_a_glance(parts, std::min(most, height));
    std::vector<std::uint32_t> rows;
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t from_middle = (i + 1) / 2, middle = count / 2;
        const std::uint32_t band = i % 2 == 0 ? middle + from_middle : middle - from_middle;
        rows.push_back(static_cast<std::uint32_t>((2 * std::uint64_t{band} + 1) * height / (2 * std::uint64_t{count})));
    }
    return rows;
}

}  // namespace wrinkle::io
