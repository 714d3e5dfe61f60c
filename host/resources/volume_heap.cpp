#include "resources/volume_heap.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>

#include "io/volume_file.h"
#include "wrinkle/error.h"

#include "layout.h"

namespace wrinkle {

namespace {

/// Blocks of background around the grid's own: the first on each side holds voxels of the grid at its border, the
/// second is background alone.
constexpr int kRing = 2;
constexpr std::size_t kMostTexels = (std::size_t{1} << 31) - 1;  // kernels count them as int

struct Shape {
    int edge, before;  ///< voxels stored along an edge; how many of them lie before the block
};

/// Copies the voxels of a block and around it.
void gather(const Volume& volume, const Shape& shape, const std::array<int, 3>& first, std::vector<float>& out) {
    out.clear();
    for (int c = 0; c < volume.info.channels; ++c)
        for (int z = 0; z < shape.edge; ++z)
            for (int y = 0; y < shape.edge; ++y)
                for (int x = 0; x < shape.edge; ++x)
                    out.push_back(volume.at(first[0] + x - shape.before, first[1] + y - shape.before,
                                            first[2] + z - shape.before, c));
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

}  // namespace

void add_volume(TextureHeap& heap, const Volume& volume, TexelKind kind) {
    const Shape shape = kind == TexelKind::volume_smooth ? Shape{10, 1} : Shape{9, 0};
    std::array<int, 3> first{}, count{};
    std::size_t blocks = 1;
    const std::size_t words = heap.table.size();
    heap.table.resize(words + WR_TEXTURE_WORDS);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = volume.first[axis] - kRing;
        count[axis] = volume.count[axis] + 2 * kRing;
        blocks *= static_cast<std::size_t>(count[axis]);
        heap.table[words + WR_VOLUME_BLOCKS + axis] = static_cast<std::uint32_t>(count[axis]);
        heap.table[words + WR_VOLUME_FIRST + axis] = static_cast<std::uint32_t>(first[axis] * Volume::edge);
    }
    const std::size_t index = heap.texels.size();
    heap.table[words + WR_VOLUME_INDEX] = static_cast<std::uint32_t>(index);
    heap.texels.resize(index + blocks);
    std::map<std::array<float, 3>, std::size_t> constants;
    std::vector<float> voxels;
    std::size_t at = index;
    for (int z = 0; z < count[2]; ++z)
        for (int y = 0; y < count[1]; ++y)
            for (int x = 0; x < count[0]; ++x, ++at) {
                gather(volume, shape,
                       {(first[0] + x) * Volume::edge, (first[1] + y) * Volume::edge, (first[2] + z) * Volume::edge},
                       voxels);
                std::size_t start = heap.texels.size();
                std::array<float, 3> value{};
                if (constant(voxels, volume.info.channels, value))
                    start = constants.try_emplace(value, start).first->second;
                if (start == heap.texels.size()) heap.texels.insert(heap.texels.end(), voxels.begin(), voxels.end());
                heap.texels[at] = std::bit_cast<float>(static_cast<std::int32_t>(start));
                if (heap.texels.size() > kMostTexels)
                    throw Error(
                        fmt::format("the grid \"{}\" takes more than the 8 GiB that the textures and volumes of a "
                                    "scene may have together: crop or resample it",
                                    volume.info.grid));
            }
}

VolumeReport volume_report(const PlannedTexture& planned) {
    const Volume volume = load_volume(planned.use.file, planned.grid);
    TextureHeap heap;
    add_volume(heap, volume, planned.kind);
    const auto stored = static_cast<std::size_t>(std::ranges::count_if(volume.blocks, [](int at) { return at >= 0; }));
    return {volume.info, volume.count, stored, heap.texels.size() * sizeof(float)};
}

}  // namespace wrinkle
