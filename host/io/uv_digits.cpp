#include "io/uv_digits.h"

#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wrinkle::io {

UvDigits uv_digits(const GBufferReader& reader) {
    if (!reader.has_role("uv")) return UvDigits::enough;
    const std::uint32_t width = reader.size().width;
    const std::array<std::string, 2> planes{"uv.u", "uv.v"};
    std::vector<float> u(width), v(width);
    const std::array<float*, 2> out{u.data(), v.data()};
    // 1 - v of a half float need not be one, so v is not asked where it is turned.
    const bool with_v = !reader.roles().v_down;
    // A ramp that a program made may hit halves by its steps alone, but then not with their last digit.
    std::size_t told = 0, halves = 0, last_digits = 0, bytes = 0;
    for (const std::uint32_t row : reader.glance_rows()) {
        reader.read_rows(row, row + 1, planes, out);
        const auto count = [&](float value) {
            if (!std::isfinite(value) || value == std::round(value)) return;  // these are whole in any format
            ++told;
            const float scaled = 255 * value;
            halves += static_cast<float>(Imath::half(value)) == value;
            last_digits += Imath::half(value).bits() & 1;
            bytes += std::abs(scaled - std::round(scaled)) < 1e-4F;
        };
        std::ranges::for_each(u, count);
        if (with_v) std::ranges::for_each(v, count);
    }
    constexpr std::size_t fewest = 32;
    if (reader.channel_type(reader.roles().channel_of.find("uv.u")->second) == ChannelType::half) return UvDigits::half;
    if (told < fewest) return UvDigits::enough;
    if (bytes == told) return UvDigits::byte;
    return halves == told && 8 * last_digits >= told ? UvDigits::half : UvDigits::enough;
}

}  // namespace wrinkle::io
