#include "io/mixed_normals.h"

#include <algorithm>
#include <cmath>

#include "base/median.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

double mixed_normals(const GBufferReader& reader) {
    constexpr float none = 0.05f, mixed = 0.9f, off = 0.02f;
    if (!reader.has_role("normal")) return 0;
    const std::vector<std::string> names{"normal.x", "normal.y", "normal.z"};
    std::vector<float> lengths, planes[3];
    std::vector<float*> into;
    for (std::vector<float>& plane : planes) {
        plane.resize(reader.size().width);
        into.push_back(plane.data());
    }
    std::size_t pixels = 0;
    for (const std::uint32_t row : reader.glance_rows()) {
        try {
            reader.read_rows(row, row + 1, names, into);
        } catch (const Error&) { return 0; }  // left to the reading of all rows, which tells the first damaged one
        for (std::size_t x = 0; x < planes[0].size(); ++x) {
            const float length = std::hypot(planes[0][x], planes[1][x], planes[2][x]);
            if (length > none && std::isfinite(length)) lengths.push_back(length);
        }
        pixels += planes[0].size();
    }
    if (std::abs(median(lengths) - 1) > off) return 0;
    const auto short_ones = std::ranges::count_if(lengths, [](float length) { return length < mixed; });
    return static_cast<double>(short_ones) / static_cast<double>(pixels);
}

}  // namespace wrinkle::io
