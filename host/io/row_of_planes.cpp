#include "io/row_of_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "io/background.h"

namespace wrinkle::io {
namespace {

constexpr float kSeen = 0.02f;    // coverage below which an object does not count
constexpr float kAligned = 0.8f;  // cosine between normals of neighbours on one surface
constexpr float kJump = 4;        // times the step before or after it, whichever is smaller: a step to another surface
constexpr float kFlat = 0.003f;   // share of 1 / depth by which neighbours on one surface may differ anyhow
constexpr float kRises = 0.1f;    // sine between a surface and the way to what lies in front of it

}  // namespace

bool RowOfPlanes::count(std::uint8_t* counts, float* front) const {
    std::fill_n(counts, width, std::uint8_t{0});
    std::fill_n(front, width, 0.0f);
    for (std::size_t k = 0; k < ranks.size(); k += 2)
        for (std::size_t x = 0; x < width; ++x) {
            const bool seen = ranks[k + 1][x] >= kSeen;
            front[x] = seen ? ranks[k][x] : front[x];
            counts[x] = static_cast<std::uint8_t>(counts[x] + (seen ? 1 : 0));
        }
    return std::any_of(counts, counts + width, [](std::uint8_t n) { return n > 1; });
}

void RowOfPlanes::seen(std::size_t x, std::vector<Seen>& out) const {
    out.clear();
    for (std::size_t k = 0; k < ranks.size(); k += 2) {
        if (!(ranks[k + 1][x] >= kSeen)) continue;
        out.push_back({std::bit_cast<std::uint32_t>(ranks[k][x]), ranks[k + 1][x]});
        for (std::size_t i = out.size() - 1; i > 0 && out[i].coverage > out[i - 1].coverage; --i)
            std::swap(out[i], out[i - 1]);
    }
}

/// The length of the step from pixel x to the next: of 1 / depth, which is linear along planes, or in space.
float RowOfPlanes::step(std::size_t x) const {
    if (place.size() == 1) return std::abs(1 / place[0][x + 1] - 1 / place[0][x]);
    float sum = 0;
    for (const float* axis : place) sum += (axis[x + 1] - axis[x]) * (axis[x + 1] - axis[x]);
    return std::sqrt(sum);
}

bool RowOfPlanes::is_surface(std::size_t x) const {
    return place.size() > 1 || (place[0][x] > 0 && place[0][x] < static_cast<float>(kBackgroundDepth));
}

bool RowOfPlanes::goes_on(std::size_t x) const {
    if (!is_surface(x) || !is_surface(x + 1)) return false;
    if (object != nullptr && object[x] != object[x + 1]) return false;
    float cosine = 0, here = 0, next = 0;
    for (const float* n : normal) {
        cosine += n[x] * n[x + 1];
        here += n[x] * n[x], next += n[x + 1] * n[x + 1];
    }
    if (!(cosine > kAligned * std::sqrt(here * next))) return false;
    const float least = place.size() == 1 ? kFlat / place[0][x] : 0.0f;
    const float length = step(x);
    if (length <= least) return true;
    const float before = x > 0 ? step(x - 1) : length, after = x + 2 < width ? step(x + 1) : length;
    return length <= kJump * std::min(before, after);
}

bool RowOfPlanes::behind(std::size_t x, std::size_t before, std::size_t front, std::size_t after) const {
    if (place.size() > 1) return rises(x, x, front) && rises(front, x, front);
    const auto inverse = [&](std::size_t i) { return 1 / place[0][i]; };
    const float apart = x < front ? static_cast<float>(front - x) : static_cast<float>(x - front);
    const float there = inverse(x), here = inverse(front), least = kFlat * here;
    return here - (there + apart * (there - inverse(before))) > least &&
           here - apart * (inverse(after) - here) - there > least;
}

/// Whether the way from one pixel to another leads out of the surface of pixel x, to where its normal points.
bool RowOfPlanes::rises(std::size_t x, std::size_t from, std::size_t to) const {
    float up = 0, way = 0, length = 0;
    for (std::size_t i = 0; i < place.size(); ++i) {
        const float d = place[i][to] - place[i][from], n = normal[i][x];
        up += n * d, way += d * d, length += n * n;
    }
    return up > kRises * std::sqrt(way * length);
}

}  // namespace wrinkle::io
