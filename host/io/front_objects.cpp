#include "io/front_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>

#include "io/background.h"

namespace wrinkle::io {
namespace {

using Id = std::uint32_t;
using Ids = std::vector<Id>;

constexpr float kSeen = 0.02f;    // coverage below which an object does not count
constexpr float kAligned = 0.8f;  // cosine between normals of neighbours on one surface
constexpr float kJump = 4;        // times the step before or after it, whichever is smaller: a step to another surface
constexpr float kFlat = 0.003f;   // share of 1 / depth by which neighbours on one surface may differ anyhow
constexpr float kByFar = 1.5f;    // times what the next object covers

struct Seen {
    Id id = 0;
    float coverage = 0;
};

bool contains(const Ids& ids, Id id) { return std::ranges::find(ids, id) != ids.end(); }
void add(Ids& ids, Id id) {
    if (!contains(ids, id)) ids.push_back(id);
}
void add(Ids& ids, const Ids& more) {
    for (const Id id : more) add(ids, id);
}

/// Consecutive pixels of a row without a jump.
struct Part {
    std::size_t begin = 0, end = 0;
    Ids alone{};  ///< objects that are alone in some of its pixels
};

/// A row of the planes that tell.
struct Row {
    std::size_t width;
    std::span<const float*const> ranks, normal, place;  ///< ids and coverages in turn
    const float* object;                                ///< or null

    /// What pixel x shows, what covers most of it first.
    void seen(std::size_t x, std::vector<Seen>& out) const {
        out.clear();
        for (std::size_t k = 0; k < ranks.size(); k += 2)
            if (ranks[k + 1][x] >= kSeen) out.push_back({std::bit_cast<Id>(ranks[k][x]), ranks[k + 1][x]});
        std::ranges::stable_sort(out, std::ranges::greater{}, &Seen::coverage);
    }

    /// The length of the step from pixel x to the next: of 1 / depth, which is linear along planes, or in space.
    float step(std::size_t x) const {
        if (place.size() == 1) return std::abs(1 / place[0][x + 1] - 1 / place[0][x]);
        float sum = 0;
        for (const float* axis : place) sum += (axis[x + 1] - axis[x]) * (axis[x + 1] - axis[x]);
        return std::sqrt(sum);
    }

    bool is_surface(std::size_t x) const {
        return place.size() > 1 || (place[0][x] > 0 && place[0][x] < static_cast<float>(kBackgroundDepth));
    }

    /// Whether pixels x and x + 1 lie on one surface. What is not finite lies on none.
    bool goes_on(std::size_t x) const {
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
};

class RowOfFronts {
public:
    explicit RowOfFronts(const Row& row) : row_(row) {
        std::vector<Seen> seen;
        for (std::size_t x = 0; x < row_.width; ++x) {
            if (parts_.empty() || !row_.goes_on(x - 1)) parts_.push_back({x, x});
            Part& part = parts_.back();
            part.end = x + 1;
            row_.seen(x, seen);
            if (seen.size() == 1) add(part.alone, seen[0].id);
        }
        if (row_.object == nullptr) return;
        for (const Part& part : parts_) add(of_number_[number(part)], part.alone);
    }

    void find(float* front) const {
        std::vector<Seen> seen;
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const Ids others = beside(k);
            for (std::size_t x = parts_[k].begin; x < parts_[k].end; ++x) {
                row_.seen(x, seen);
                front[x] = seen.empty() ? 0.0f : chosen(parts_[k], others, seen);
            }
        }
    }

private:
    /// The bits of a part's object number, as numbers may be anything.
    std::uint32_t number(const Part& part) const { return std::bit_cast<std::uint32_t>(row_.object[part.begin]); }

    /// Objects that a part is not of, unless they are alone in it: those across its jumps, and those that have another
    /// number.
    Ids beside(std::size_t k) const {
        Ids ids;
        if (k > 0) add(ids, parts_[k - 1].alone);
        if (k + 1 < parts_.size()) add(ids, parts_[k + 1].alone);
        if (row_.object == nullptr) return ids;
        const std::uint32_t own = number(parts_[k]);
        for (const auto& [other, alone] : of_number_)
            if (other != own) add(ids, alone);
        std::erase_if(ids, [&](Id id) { return contains(of_number_.at(own), id); });
        return ids;
    }

    float chosen(const Part& part, const Ids& others, std::vector<Seen> seen) const {
        const auto first = [&](const Ids& ids) {
            return std::ranges::find_if(seen, [&](const Seen& s) { return contains(ids, s.id); });
        };
        if (seen.size() == 1) return std::bit_cast<float>(seen[0].id);
        if (const auto found = first(part.alone); found != seen.end()) return std::bit_cast<float>(found->id);
        if (row_.object != nullptr) {
            const Ids& same = of_number_.at(number(part));
            if (const auto found = first(same); same.size() == 1 && found != seen.end())
                return std::bit_cast<float>(found->id);
        }
        std::vector<Seen> left = seen;
        std::erase_if(left, [&](const Seen& s) { return contains(others, s.id); });
        if (left.empty()) left = std::move(seen);
        if (left.size() == 1 || left[0].coverage >= kByFar * left[1].coverage) return std::bit_cast<float>(left[0].id);
        return kNobodyKnows;
    }

    const Row& row_;
    std::vector<Part> parts_;
    std::map<std::uint32_t, Ids> of_number_;  ///< objects that are alone in parts of an object number
};

}  // namespace

FrontObjects::FrontObjects(const RoleMap& roles) {
    const bool depth = roles.has_role("depth");
    if (roles.cryptomatte_ranks == 0 || !roles.has_role("normal") || !(depth || roles.has_role("position"))) return;
    ranks_ = static_cast<std::size_t>(roles.cryptomatte_ranks);
    for (std::size_t k = 0; k < ranks_; ++k)
        for (const char* part : {"id", "coverage"}) needed_.push_back(fmt::format("crypto.{}{}", part, k));
    for (const char axis : {'x', 'y', 'z'}) needed_.push_back(fmt::format("normal.{}", axis));
    if (depth)
        needed_.emplace_back("depth");
    else
        for (const char axis : {'x', 'y', 'z'}) needed_.push_back(fmt::format("position.{}", axis));
    places_ = depth ? 1 : 3;
    object_ = roles.has_role("object");
    if (object_) needed_.emplace_back("object");
}

void FrontObjects::read(std::span<const std::string> planes, std::span<float* const> out, std::size_t width,
                        std::size_t count, const Read& read) const {
    std::vector<std::string> names;
    std::vector<float*> into;
    float* front = nullptr;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        if (planes[i] == kFrontPlane) {
            front = out[i];
        } else {
            names.push_back(planes[i]);
            into.push_back(out[i]);
        }
    }
    std::vector<std::vector<float>> more;
    std::vector<const float*> used;
    more.reserve(needed_.size());  // they stay where they are
    for (const std::string& name : needed_) {
        const auto found = std::ranges::find(names, name);
        if (found == names.end()) {
            names.push_back(name);
            into.push_back(more.emplace_back(count).data());
            used.push_back(into.back());
        } else {
            used.push_back(into[static_cast<std::size_t>(found - names.begin())]);
        }
    }
    read(names, into);
    find(used, width, {front, count});
}

void FrontObjects::find(std::span<const float* const> planes, std::size_t width, std::span<float> front) const {
    std::vector<const float*> here(planes.begin(), planes.end());
    for (std::size_t at = 0; at < front.size(); at += width) {
        const std::span<const float* const> all(here);
        const Row row{width, all.first(2 * ranks_), all.subspan(2 * ranks_, 3), all.subspan(2 * ranks_ + 3, places_),
                      object_ ? all.back() : nullptr};
        RowOfFronts(row).find(front.data() + at);
        for (const float*& plane : here) plane += width;
    }
}

}  // namespace wrinkle::io
