#include "plan/decal_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace wrinkle {

namespace {

/// The bits of a number below 2^21, each followed by two zeros.
std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 32) & 0x1f00000000ffffu;
    v = (v | v << 16) & 0x1f0000ff0000ffu;
    v = (v | v << 8) & 0x100f00f00f00f00fu;
    v = (v | v << 4) & 0x10c30c30c30c30c3u;
    return (v | v << 2) & 0x1249249249249249u;
}

/// `place` gets the position of a row.
template <class Row>
std::vector<std::uint64_t> morton_codes(const std::vector<Row>& rows, Vec3 Row::*place) {
    Vec3 low, high;
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
    for (const Row& row : rows)
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], (row.*place)[k]);
            high[k] = std::max(high[k], (row.*place)[k]);
        }
    double widest = 0;
    for (std::size_t k = 0; k < 3; ++k) widest = std::max(widest, high[k] / 2 - low[k] / 2);
    std::vector<std::uint64_t> codes;
    codes.reserve(rows.size());
    for (const Row& row : rows) {
        std::uint64_t code = 0;
        for (std::size_t k = 0; k < 3 && widest > 0; ++k)
            code |= spread(static_cast<std::uint64_t>(((row.*place)[k] / 2 - low[k] / 2) / widest * 2097151)) << k;
        codes.push_back(code);
    }
    return codes;
}

auto content(const Projector& r) {
    return std::tie(r.center, r.axis_x, r.axis_y, r.half_size, r.texture, r.region, r.scale, r.shape, r.falloff,
                    r.angle_fade, r.two_sided, r.wrap, r.repeat, r.opacity, r.object, r.cryptomatte);
}
auto content(const Light& l) {
    return std::tie(l.position, l.color, l.intensity, l.range, l.kind, l.direction, l.inner_angle, l.outer_angle);
}

}  // namespace

std::vector<std::uint32_t> decal_order(const std::vector<Projector>& rows) {
    std::vector<std::uint32_t> order(rows.size());
    std::iota(order.begin(), order.end(), 0u);
    if (std::ranges::any_of(rows, [](const Projector& row) { return row.mode == ProjectorMode::replace; })) {
        std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return rows[i].priority; });
        return order;
    }
    const std::vector<std::uint64_t> codes = morton_codes(rows, &Projector::center);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return codes[a] != codes[b] ? codes[a] < codes[b] : content(rows[a]) < content(rows[b]);
    });
    return order;
}

std::vector<std::uint32_t> light_order(const std::vector<Light>& rows) {
    std::vector<std::uint32_t> order(rows.size());
    std::iota(order.begin(), order.end(), 0u);
    const std::vector<std::uint64_t> codes = morton_codes(rows, &Light::position);
    std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
        return codes[a] != codes[b] ? codes[a] < codes[b] : content(rows[a]) < content(rows[b]);
    });
    return order;
}

}  // namespace wrinkle
