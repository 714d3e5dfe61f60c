#include "io/packed_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "base/median.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

using Texel = std::array<float, 3>;

float length(const Texel& n) { return std::hypot(n[0], n[1], n[2]); }
Texel unpacked(const Texel& n) { return {2 * n[0] - 1, 2 * n[1] - 1, 2 * n[2] - 1}; }

/// The vectors, but for holes, and for the one of a background that may fill most of the picture.
std::vector<Texel> of_surfaces(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    std::vector<Texel> all;
    std::map<Texel, std::size_t> times;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Texel n{x[i], y[i], z[i]};
        if (n == Texel{} || !std::isfinite(n[0] + n[1] + n[2])) continue;
        all.push_back(n);
        ++times[n];
    }
    const auto most = std::ranges::max_element(times, {}, &std::pair<const Texel, std::size_t>::second);
    if (most == times.end() || most->second == all.size()) return all;
    std::erase(all, Texel(most->first));
    return all;
}

}  // namespace

bool cannot_be_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    constexpr float rounding = 0.01f;  // allows for half floats and 8-bit sources
    const auto outside = [](float c) { return c < -rounding || c > 1 + rounding; };
    for (std::size_t i = 0; i < x.size(); ++i)
        if (std::isfinite(x[i] + y[i] + z[i]) && (outside(x[i]) || outside(y[i]) || outside(z[i]))) return true;
    return false;
}

bool looks_packed(std::span<const float> x, std::span<const float> y, std::span<const float> z) {
    if (cannot_be_packed(x, y, z)) return false;
    constexpr float unit_length = 0.03f;  // allows for filtering, which shortens normals a little
    std::vector<float> raw, decoded;
    for (const Texel& n : of_surfaces(x, y, z))
        raw.push_back(std::abs(length(n) - 1)), decoded.push_back(std::abs(length(unpacked(n)) - 1));
    return !raw.empty() && median(decoded) < unit_length && median(raw) > unit_length;
}

void turn_normals(const Mat4& view, std::span<float> x, std::span<float> y, std::span<float> z) {
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double n[3] = {x[i], y[i], z[i]};
        const auto world = [&](std::size_t k) {  // the view is rigid: its inverse is its transpose
            return static_cast<float>(view[0][k] * n[0] + view[1][k] * n[1] + view[2][k] * n[2]);
        };
        x[i] = world(0), y[i] = world(1), z[i] = world(2);
    }
}

void unpack_normals(std::span<float> x, std::span<float> y, std::span<float> z) {
    constexpr float shortest = 0.125f, longest = 1.25f;  // what filtering leaves of a normal
    for (std::size_t i = 0; i < x.size(); ++i) {
        const Texel n = unpacked({x[i], y[i], z[i]});
        const bool none = length(n) < shortest || length(n) > longest;
        x[i] = none ? 0 : n[0], y[i] = none ? 0 : n[1], z[i] = none ? 0 : n[2];
    }
}

bool are_packed(BandReader& reader, const std::array<ChannelPlace, 3>& axes, std::span<const std::uint32_t> rows,
                std::size_t width) {
    std::vector<float> planes[3];
    for (const std::uint32_t row : rows) {  // the first one nearly always decides
        std::vector<WantedChannel> wanted;
        std::span<const float> read[3];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            planes[axis].resize(planes[axis].size() + width);
            read[axis] = std::span(planes[axis]).last(width);
            wanted.push_back({axes[axis], planes[axis].data() + planes[axis].size() - width});
        }
        try {
            reader.read(row, row + 1, wanted);
        } catch (const Error&) { return false; }
        if (cannot_be_packed(read[0], read[1], read[2])) return false;
    }
    return looks_packed(planes[0], planes[1], planes[2]);
}

}  // namespace wrinkle::io
