#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace wrinkle::io {

/// Blocks of a frame, decompressed with all their channels. Whoever looks at a frame before it is read reads a few rows
/// here and there, for one purpose after the other, and each row costs its whole block: what the first look
/// decompressed serves the others.
class KeptBlocks {
public:
    /// The block of a part that begins with this row; empty when it is not kept.
    std::span<const float> find(int part, int first_row) const {
        const auto found = blocks_.find({part, first_row});
        return found == blocks_.end() ? std::span<const float>() : found->second;
    }

    /// Whether so many floats more may be kept.
    bool has_room(std::size_t floats) const { return held_ + floats <= kMost; }

    std::span<const float> keep(int part, int first_row, std::vector<float> floats) {
        held_ += floats.size();
        return blocks_[{part, first_row}] = std::move(floats);
    }

    void clear() { blocks_.clear(), held_ = 0; }

private:
    static constexpr std::size_t kMost = 32u << 20;  // 128 MiB

    std::map<std::pair<int, int>, std::vector<float>> blocks_;
    std::size_t held_ = 0;
};

}  // namespace wrinkle::io
