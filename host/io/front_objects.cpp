#include "io/front_objects.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>

#include "io/row_of_planes.h"

namespace wrinkle::io {
namespace {

constexpr float kByFar = 1.5f;  // times what the next object covers

using Id = std::uint32_t;

bool shows(const std::vector<Seen>& seen, Id id) { return std::ranges::find(seen, id, &Seen::id) != seen.end(); }

/// Which objects belong to which numbered groups.
class Groups {
public:
    void add(std::uint32_t group, Id id) {
        if (keys_.empty() || keys_.back() != key(group, id)) keys_.push_back(key(group, id));
    }
    /// After all were added, before they are asked for.
    void sort() {
        std::ranges::sort(keys_);
        keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    }
    bool has(std::uint32_t group, Id id) const { return std::ranges::binary_search(keys_, key(group, id)); }
    bool has_one(std::uint32_t group) const {
        const auto first = std::ranges::lower_bound(keys_, key(group, 0));
        const auto is_in = [&](auto i) { return i != keys_.end() && *i >> 32 == group; };
        return is_in(first) && !is_in(first + 1);
    }

private:
    static std::uint64_t key(std::uint32_t group, Id id) { return std::uint64_t{group} << 32 | id; }
    std::vector<std::uint64_t> keys_;
};

/// Consecutive pixels of a row without a jump.
struct Part {
    std::uint32_t begin = 0, end = 0;
    bool tells = false;  ///< some pixels show one object, or nothing
};

class RowOfFronts {
public:
    /// `front` holds the objects of the pixels that show one.
    RowOfFronts(const RowOfPlanes& row, const std::uint8_t* counts, float* front)
        : row_(row), counts_(counts), front_(front) {
        for (std::uint32_t x = 0; x < row_.width; ++x) {
            if (parts_.empty() || !row_.goes_on(x - 1)) parts_.push_back({x, x});
            Part& part = parts_.back();
            part.end = x + 1;
            part.tells |= counts[x] < 2;
            if (counts[x] != 1) continue;
            const Id id = std::bit_cast<Id>(front[x]);
            in_part_.add(part.begin, id);
            if (row_.object == nullptr) continue;
            in_number_.add(number(part), id);
            in_any_.add(0, id);
        }
        for (Groups* groups : {&in_part_, &in_number_, &in_any_}) groups->sort();
    }

    void find() const {
        std::vector<Seen> seen;
        const Part* left = nullptr;
        const Part* const end = parts_.data() + parts_.size();
        const Part* right = parts_.data();
        for (const Part& part : parts_) {
            right = std::max(right, &part + 1);
            while (right != end && !right->tells) ++right;
            std::optional<Around> around;
            for (std::size_t x = part.begin; x < part.end; ++x) {
                if (counts_[x] < 2) continue;
                row_.seen(x, seen);
                const Seen* found = alone_in(part, seen);
                if (found == nullptr) {
                    if (!around) around = look_around(part, left, right == end ? nullptr : right);
                    found = likely(part, *around, seen);
                }
                front_[x] = found == nullptr ? kNobodyKnows : std::bit_cast<float>(found->id);
            }
            if (part.tells) left = &part;
        }
    }

private:
    /// What lies beside a part.
    struct Around {
        struct Side {
            const Part* part = nullptr;  ///< the next that tells; null at the end of the row
            bool behind = false;         ///< it goes on behind the part
        };
        Side left, right;
        std::vector<Seen> throughout;  ///< what all pixels of the part show
    };

    Around look_around(const Part& part, const Part* left, const Part* right) const {
        const auto last = [](const Part& p) { return p.end - 1; };
        const auto second = [&](const Part& p) { return std::min(p.begin + 1, last(p)); };
        const auto last_but_one = [&](const Part& p) { return std::max(p.end, p.begin + 2) - 2; };
        Around around;
        if (left != nullptr)
            around.left = {left, row_.behind(last(*left), last_but_one(*left), part.begin, second(part))};
        if (right != nullptr)
            around.right = {right, row_.behind(right->begin, second(*right), last(part), last_but_one(part))};
        row_.seen(part.begin, around.throughout);
        std::vector<Seen> seen;
        for (std::size_t x = part.begin + 1; x < part.end && !around.throughout.empty(); ++x) {
            row_.seen(x, seen);
            std::erase_if(around.throughout, [&](const Seen& s) { return !shows(seen, s.id); });
        }
        return around;
    }

    /// The bits of a part's object number, as numbers may be anything.
    std::uint32_t number(const Part& part) const { return std::bit_cast<std::uint32_t>(row_.object[part.begin]); }

    /// Whether a part that an object is not alone in is of others, as the object has another number or goes on behind
    /// it. Where it goes on at one side only, it may as well end in the part, unless some pixels there do not show it.
    bool is_elsewhere(const Part& part, const Around& around, Id id) const {
        if (row_.object != nullptr) {
            if (in_number_.has(number(part), id)) return false;
            if (in_any_.has(0, id)) return true;
        }
        const auto goes_on = [&](const Around::Side& side) {
            return side.behind && in_part_.has(side.part->begin, id);
        };
        const bool left = goes_on(around.left), right = goes_on(around.right);
        if (left && right) return true;
        if (!left && !right) return false;
        return (left ? around.right : around.left).part == nullptr || !shows(around.throughout, id);
    }

    /// What is alone in a part, or the only one that is in its object number; null if there is none.
    const Seen* alone_in(const Part& part, const std::vector<Seen>& seen) const {
        for (const Seen& s : seen)
            if (in_part_.has(part.begin, s.id)) return &s;
        if (row_.object != nullptr && in_number_.has_one(number(part)))
            for (const Seen& s : seen)
                if (in_number_.has(number(part), s.id)) return &s;
        return nullptr;
    }

    /// What covers most by far of what is not elsewhere; null if nothing does.
    const Seen* likely(const Part& part, const Around& around, const std::vector<Seen>& seen) const {
        const Seen *most = nullptr, *next = nullptr;
        for (const Seen& s : seen)
            if (next == nullptr && !is_elsewhere(part, around, s.id)) (most == nullptr ? most : next) = &s;
        if (most == nullptr) most = &seen[0], next = &seen[1];
        return next == nullptr || most->coverage >= kByFar * next->coverage ? most : nullptr;
    }

    const RowOfPlanes& row_;
    const std::uint8_t* counts_;
    float* front_;
    std::vector<Part> parts_;
    Groups in_part_, in_number_, in_any_;  ///< objects that are alone in pixels of a part (by its begin) or a number
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
    std::vector<std::uint8_t> counts(width);
    for (std::size_t at = 0; at < front.size(); at += width) {
        const std::span<const float* const> all(here);
        const RowOfPlanes row{width, all.first(2 * ranks_), all.subspan(2 * ranks_, 3),
                              all.subspan(2 * ranks_ + 3, places_), object_ ? all.back() : nullptr};
        if (row.count(counts.data(), front.data() + at)) RowOfFronts(row, counts.data(), front.data() + at).find();
        for (const float*& plane : here) plane += width;
    }
}

}  // namespace wrinkle::io
