#include "resources/volume_heap.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <optional>

#include "base/limits.h"
#include "base/names.h"
#include "io/volume_file.h"
#include "resources/volume_levels.h"
#include "resources/volume_products.h"
#include "wrinkle/error.h"

#include "layout.h"

namespace wrinkle {

namespace {

constexpr double kMostTexels = (std::int64_t{1} << 31) - 1;  // kernels count them as int
constexpr std::int32_t kToFill = -1;                         // of a block whose voxels are still to be stored

struct Shape {
    int edge, before;  ///< voxels stored along an edge; how many of them lie before the block
};

/// The numbers (Volume::blocks) of a block and the 26 around it, x fastest.
class Neighbourhood {
public:
    Neighbourhood(const Volume& volume, const std::array<int, 3>& block) {
        std::size_t i = 0;
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x) {
                    const auto place = volume.block(block[0] + x, block[1] + y, block[2] + z);
                    numbers_[i++] = place ? volume.blocks[*place] : -1;
                }
    }

    /// Of the block that holds a voxel, counted from the middle block's first.
    std::int32_t at(int x, int y, int z) const {
        return numbers_[static_cast<std::size_t>(((z >> 3) + 1) * 9 + ((y >> 3) + 1) * 3 + (x >> 3) + 1)];
    }

    /// The constant that all voxels of a shape have; nothing when a block with voxels of its own, or another constant,
    /// is among them.
    std::optional<std::int32_t> constant(const Shape& shape) const {
        const int first = shape.before > 0 ? -1 : 0, middle = at(0, 0, 0);
        for (int z = first; z <= 1; ++z)
            for (int y = first; y <= 1; ++y)
                for (int x = first; x <= 1; ++x)
                    if (at(8 * x, 8 * y, 8 * z) != middle) return {};
        return middle < 0 ? std::optional(middle) : std::nullopt;
    }

private:
    std::array<std::int32_t, 27> numbers_{};
};

/// Copies the voxels of a block and around it.
void gather(const Volume& volume, const Shape& shape, const Neighbourhood& around, std::vector<float>& out) {
    out.clear();
    const auto channels = static_cast<std::size_t>(volume.info.channels);
    const int first = -shape.before, end = shape.edge - shape.before;
    for (std::size_t c = 0; c < channels; ++c)
        for (int z = first; z < end; ++z)
            for (int y = first; y < end; ++y)
                for (int x = first; x < end; ++x) {
                    const std::int32_t number = around.at(x, y, z);
                    if (number < 0) {
                        out.push_back(volume.constants[3 * static_cast<std::size_t>(-1 - number) + c]);
                        continue;
                    }
                    const std::size_t block = static_cast<std::size_t>(number) * channels + c;
                    const int voxel = ((z & 7) * Volume::edge + (y & 7)) * Volume::edge + (x & 7);
                    out.push_back(volume.voxels[block * Volume::block_voxels + static_cast<std::size_t>(voxel)]);
                }
}

/// Whether every channel has one value, which is then in `value`.
bool constant(const std::vector<float>& voxels, int channels, std::array<float, 3>& value) {
    const std::size_t size = voxels.size() / static_cast<std::size_t>(channels);
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
        value[c] = voxels[c * size];
        for (std::size_t i = 1; i < size; ++i)
            if (voxels[c * size + i] != value[c]) return false;
    }
    return true;
}

/// Where the blocks of a volume start in a heap, while they are put there.
class Blocks {
public:
    Blocks(TextureHeap& heap, const Volume& volume, const Shape& shape)
        : heap_(heap), volume_(volume), shape_(shape), index_(heap.texels.size()) {
        double blocks = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            count_[axis] = volume.count[axis] + 2 * Volume::ring;
            blocks *= count_[axis];
        }
        check_room(blocks);
        const double voxels =
            static_cast<double>(volume.voxels.size()) / Volume::block_voxels * std::pow(shape.edge, 3);
        check_memory(quote(volume.info.grid), sizeof(float) * (blocks + voxels),
                     fmt::format("what kernels read of the grid, {:.0f} blocks", blocks));
        heap_.texels.resize(index_ + static_cast<std::size_t>(blocks));
        const std::size_t background = add_constant(-1);
        std::fill_n(heap_.texels.begin() + static_cast<std::ptrdiff_t>(index_), static_cast<std::size_t>(blocks),
                    as_texel(static_cast<std::int32_t>(background)));
    }

    /// Stores what differs from the background: blocks of the grid, and those whose surroundings reach into one.
    void fill() {
        mark();
        std::vector<float> voxels;
        std::size_t at = index_;
        for (int z = 0; z < count_[2]; ++z)
            for (int y = 0; y < count_[1]; ++y)
                for (int x = 0; x < count_[0]; ++x, ++at)
                    if (std::bit_cast<std::int32_t>(heap_.texels[at]) == kToFill) {
                        const std::size_t start = store({x, y, z}, voxels);
                        heap_.texels[at] = as_texel(static_cast<std::int32_t>(start));
                    }
    }

    int count(std::size_t axis) const { return count_[axis]; }
    std::size_t index() const { return index_; }

private:
    static float as_texel(std::int32_t start) { return std::bit_cast<float>(start); }

    void check_room(double more) const {
        if (static_cast<double>(heap_.texels.size()) + more <= kMostTexels) return;
        throw Error(
            fmt::format("the grid \"{}\" takes more than the 8 GiB that the textures and volumes of a scene may have "
                        "together: crop or resample it",
                        volume_.info.grid));
    }

    /// Marks the blocks that may need voxels: those that hold, or touch a block that holds, more than background. A
    /// block whose whole neighbourhood is one constant gets that constant here instead, without the work of gathering
    /// its voxels; in a large grid that can be nearly all of them.
    void mark() {
        std::int32_t last = -1;
        std::size_t start = 0, place = 0;
        for (int z = 0; z < volume_.count[2]; ++z)
            for (int y = 0; y < volume_.count[1]; ++y)
                for (int x = 0; x < volume_.count[0]; ++x, ++place) {
                    const std::int32_t number = volume_.blocks[place];
                    if (number == -1) continue;
                    if (!is_deep(x, y, z, place)) {
                        mark_around(x + Volume::ring, y + Volume::ring, z + Volume::ring);
                        continue;
                    }
                    if (number != last) start = add_constant(number), last = number;
                    texel_of(x + Volume::ring, y + Volume::ring, z + Volume::ring) =
                        as_texel(static_cast<std::int32_t>(start));
                }
    }

    /// Whether a block and all 26 around it are of one constant.
    bool is_deep(int x, int y, int z, std::size_t place) const {
        const auto is_inner = [&](int at, std::size_t axis) { return at > 0 && at + 1 < volume_.count[axis]; };
        const std::int32_t number = volume_.blocks[place];
        if (number >= 0 || !is_inner(x, 0) || !is_inner(y, 1) || !is_inner(z, 2)) return false;
        const std::ptrdiff_t row = volume_.count[0], slice = row * volume_.count[1];
        for (int dz = -1; dz <= 1; ++dz)
            for (int dy = -1; dy <= 1; ++dy) {
                const std::int32_t* at = volume_.blocks.data() + place + dz * slice + dy * row;
                if (at[-1] != number || at[0] != number || at[1] != number) return false;
            }
        return true;
    }

    float& texel_of(int x, int y, int z) {
        const std::size_t row =
            static_cast<std::size_t>(z) * static_cast<std::size_t>(count_[1]) + static_cast<std::size_t>(y);
        return heap_.texels[index_ + row * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(x)];
    }

    void mark_around(int x, int y, int z) {
        const int after = shape_.before > 0 ? 1 : 0;
        for (int dz = -1; dz <= after; ++dz)
            for (int dy = -1; dy <= after; ++dy)
                for (int dx = -1; dx <= after; ++dx) texel_of(x + dx, y + dy, z + dz) = as_texel(kToFill);
    }

    /// Where the voxels of a block of the ringed box start. Stores them first, unless they are stored already.
    std::size_t store(const std::array<int, 3>& block, std::vector<float>& voxels) {
        std::array<int, 3> at;
        for (std::size_t axis = 0; axis < 3; ++axis) at[axis] = volume_.first[axis] - Volume::ring + block[axis];
        const Neighbourhood around(volume_, at);
        std::array<float, 3> value{};
        if (const auto number = around.constant(shape_)) return add_constant(*number);
        gather(volume_, shape_, around, voxels);
        return constant(voxels, volume_.info.channels, value) ? add_constant(value) : add(voxels);
    }

    std::size_t add_constant(std::int32_t number) {
        const float* constants = volume_.constants.data() + 3 * static_cast<std::ptrdiff_t>(-1 - number);
        return add_constant(std::array{constants[0], constants[1], constants[2]});
    }

    std::size_t add_constant(std::array<float, 3> value) {
        for (std::size_t c = static_cast<std::size_t>(volume_.info.channels); c < 3; ++c) value[c] = 0;
        if (const auto found = constants_.find(value); found != constants_.end()) return found->second;
        const std::size_t voxels = static_cast<std::size_t>(shape_.edge) * static_cast<std::size_t>(shape_.edge) *
                                   static_cast<std::size_t>(shape_.edge);
        std::vector<float> block;
        for (std::size_t c = 0; c < static_cast<std::size_t>(volume_.info.channels); ++c)
            block.insert(block.end(), voxels, value[c]);
        return constants_[value] = add(block);
    }

    std::size_t add(const std::vector<float>& voxels) {
        check_room(static_cast<double>(voxels.size()));
        const std::size_t start = heap_.texels.size();
        heap_.texels.insert(heap_.texels.end(), voxels.begin(), voxels.end());
        return start;
    }

    TextureHeap& heap_;
    const Volume& volume_;
    Shape shape_;
    std::size_t index_;
    std::array<int, 3> count_{};
    std::map<std::array<float, 3>, std::size_t> constants_;
};

/// Stores a volume; adds its row to a table.
void store(TextureHeap& heap, std::vector<std::uint32_t>& table, const Volume& volume, TexelKind kind) {
    Blocks blocks(heap, volume, kind == TexelKind::volume_smooth ? Shape{10, 1} : Shape{9, 0});
    const std::size_t words = table.size();
    table.resize(words + WR_TEXTURE_WORDS);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int first = (volume.first[axis] - Volume::ring) * Volume::edge;
        table[words + WR_VOLUME_BLOCKS + axis] = static_cast<std::uint32_t>(blocks.count(axis));
        table[words + WR_VOLUME_FIRST + axis] = static_cast<std::uint32_t>(first);
    }
    table[words + WR_VOLUME_INDEX] = static_cast<std::uint32_t>(blocks.index());
    blocks.fill();
}

}  // namespace

void add_volume(TextureHeap& heap, const Volume& volume, TexelKind kind) { store(heap, heap.table, volume, kind); }

void add_planned_volume(TextureHeap& heap, const Volume& volume, const PlannedTexture& planned, std::size_t rows) {
    store(heap, heap.table, volume, planned.kind);
    if (!planned.levels) return;
    const std::vector<Volume> levels = coarser_levels(volume);
    std::uint32_t* words = &heap.table[heap.table.size() - WR_TEXTURE_WORDS];
    words[WR_VOLUME_LEVELS] = static_cast<std::uint32_t>(levels.size());
    words[WR_VOLUME_COARSER] = static_cast<std::uint32_t>(rows + heap.further.size() / WR_TEXTURE_WORDS);
    for (const Volume& level : levels) store(heap, heap.further, level, planned.kind);
    if (!planned.products) return;
    const bool smooth = planned.kind == TexelKind::volume_smooth;
    for (const SlopeProducts& products :
         product_levels(volume, smooth ? VolumeFilter::smooth : VolumeFilter::linear, levels.size())) {
        store(heap, heap.further, products.first, TexelKind::volume);
        store(heap, heap.further, products.second, TexelKind::volume);
    }
}

VolumeReport volume_report(const PlannedTexture& planned) {
    const Volume volume = load_volume(planned.use.file, planned.grid);
    TextureHeap heap;
    add_planned_volume(heap, volume, planned, 1);
    const auto stored = static_cast<std::size_t>(std::ranges::count_if(volume.blocks, [](int at) { return at >= 0; }));
    return {volume.info, volume.count, stored, heap.texels.size() * sizeof(float), heap.table[WR_VOLUME_LEVELS]};
}

}  // namespace wrinkle
