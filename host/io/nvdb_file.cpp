// The only file that includes NanoVDB's headers, besides the benchmark that races against it.
#define NANOVDB_USE_BLOSC
#define NANOVDB_USE_ZIP
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/GridChecksum.h>
#include <nanovdb/util/IO.h>

#include "io/nvdb_segments.h"
#include "io/volume_grid.h"

namespace wrinkle::io {

namespace {

std::array<float, 3> numbers(double v) { return {static_cast<float>(v), 0, 0}; }
template <class T>
std::array<float, 3> numbers(const nanovdb::Vec3<T>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

constexpr std::size_t kMostTiles = std::size_t{1} << 25;

template <class T>
void add_tile(RawVolume& raw, const nanovdb::Coord& first, int size, const T& value, const T& background) {
    if (value == background) return;
    if (raw.tiles.size() == kMostTiles)
        throw std::runtime_error("it has more constant regions than " + std::to_string(kMostTiles));
    RawVolume::Tile tile{{}, {}, numbers(value)};
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        tile.first[k] = first[axis] >> 3;
        tile.last[k] = static_cast<int>((std::int64_t{first[axis]} + size - 1) >> 3);
    }
    raw.tiles.push_back(tile);
}

template <class Node, class T>
void add_tiles(RawVolume& raw, const Node* node, std::uint32_t count, const T& background) {
    for (std::uint32_t k = 0; k < count; ++k)
        for (std::uint32_t i = 0; i < Node::SIZE; ++i)
            if (!node[k].data()->isChild(i))
                add_tile(raw, node[k].offsetToGlobalCoord(i), Node::ChildNodeType::DIM, node[k].data()->getValue(i),
                         background);
}

/// A grid in memory, whose offsets and counts are not followed before they are known to stay within it.
template <class Build>
class CheckedGrid {
public:
    explicit CheckedGrid(const nanovdb::HostBuffer& buffer)
        : grid_(reinterpret_cast<const nanovdb::NanoGrid<Build>*>(buffer.data())), size_(buffer.size()) {
        const auto* data = reinterpret_cast<const nanovdb::GridData*>(grid_);
        require(data->mMagic == NANOVDB_MAGIC_NUMBER && data->mGridSize <= size_, "the grid's own header");
        require(range(3, 1, sizeof(Root)) && root().data()->mTableSize <= left(3, sizeof(Root)) / sizeof(RootTile),
                "its root");
        require(nanovdb::validateChecksum(*grid_, nanovdb::ChecksumMode::Partial), "a checksum");
        require(range(2, count(2), sizeof(Upper)), "its upper nodes");
        require(range(1, count(1), sizeof(Lower)), "its lower nodes");
        require(range(0, count(0), sizeof(Leaf)), "its leaves");
    }

    void read(RawVolume& raw) const {
        const auto background = root().background();
        raw.background = numbers(background);
        for (std::uint32_t i = 0; i < root().data()->mTableSize; ++i)
            if (const auto* tile = root().data()->tile(i); !tile->isChild())
                add_tile(raw, tile->origin(), Upper::DIM, tile->value, background);
        add_tiles(raw, first<Upper>(2), count(2), background);
        add_tiles(raw, first<Lower>(1), count(1), background);
        read_leaves(raw);
    }

private:
    using Root = nanovdb::NanoRoot<Build>;
    using RootTile = typename Root::DataType::Tile;
    using Upper = nanovdb::NanoUpper<Build>;
    using Lower = nanovdb::NanoLower<Build>;
    using Leaf = nanovdb::NanoLeaf<Build>;

    static void require(bool sound, const std::string& what) {
        if (!sound) throw std::runtime_error("damaged: " + what + " does not fit into the file");
    }

    // Offsets count from the tree, which follows the grid's header.
    const char* tree() const { return reinterpret_cast<const char*>(grid_ + 1); }
    const nanovdb::TreeData<3>& tree_data() const { return *reinterpret_cast<const nanovdb::TreeData<3>*>(tree()); }
    std::uint64_t offset(int level) const { return tree_data().mNodeOffset[level]; }
    std::uint32_t count(int level) const { return tree_data().mNodeCount[level]; }
    std::uint64_t tree_size() const { return size_ - sizeof(*grid_); }
    /// Bytes between the end of the first node of a level and that of the buffer.
    std::uint64_t left(int level, std::uint64_t node) const { return tree_size() - offset(level) - node; }

    bool range(int level, std::uint64_t nodes, std::uint64_t bytes) const {
        if (nodes == 0) return true;
        const std::uint64_t at = offset(level);
        return at >= sizeof(nanovdb::TreeData<3>) && at % NANOVDB_DATA_ALIGNMENT == 0 && at <= tree_size() &&
               nodes <= (tree_size() - at) / bytes;
    }

    template <class Node>
    const Node* first(int level) const {
        return reinterpret_cast<const Node*>(tree() + offset(level));
    }
    const Root& root() const { return *first<Root>(3); }

    void read_leaves(RawVolume& raw) const {
        if constexpr (Leaf::FIXED_SIZE) {
            for (std::uint32_t k = 0; k < count(0); ++k) add_leaf(raw, first<Leaf>(0)[k]);
        } else {  // each says how many bits its voxels take
            std::uint64_t at = offset(0);
            for (std::uint32_t k = 0; k < count(0); ++k) {
                const auto* leaf = reinterpret_cast<const Leaf*>(tree() + at);
                require(at <= tree_size() && sizeof(Leaf) <= tree_size() - at &&
                            leaf->data()->memUsage() <= tree_size() - at,
                        "a leaf");
                add_leaf(raw, *leaf);
                at += leaf->data()->memUsage();
            }
        }
    }

    const nanovdb::NanoGrid<Build>* grid_;
    std::uint64_t size_;
};

/// Calls `work` with std::type_identity of the type that a grid's voxels are built as. False for types not read here.
template <class Work>
bool as_typed(std::uint32_t type, const Work& work) {
    const auto as = [&](auto build) {
        const bool is = type == static_cast<std::uint32_t>(nanovdb::mapToGridType<typename decltype(build)::type>());
        if (is) work(build);
        return is;
    };
    using std::type_identity;
    return as(type_identity<float>{}) || as(type_identity<double>{}) || as(type_identity<nanovdb::Vec3f>{}) ||
           as(type_identity<nanovdb::Vec3d>{}) || as(type_identity<nanovdb::Fp4>{}) ||
           as(type_identity<nanovdb::Fp8>{}) || as(type_identity<nanovdb::Fp16>{}) || as(type_identity<nanovdb::FpN>{});
}

}  // namespace

std::uint32_t nvdb_version() { return NANOVDB_MAJOR_VERSION_NUMBER; }

std::vector<ListedGrid> list_nvdb(const InputFile& file) {
    std::vector<ListedGrid> grids;
    for (const NvdbGrid& grid : list_nvdb_grids(file)) {
        const bool known = grid.type < static_cast<std::uint32_t>(nanovdb::GridType::End);
        grids.push_back({grid.name, known ? nanovdb::toStr(static_cast<nanovdb::GridType>(grid.type)) : "?",
                         as_typed(grid.type, [](auto) {})});
    }
    return grids;
}

RawVolume read_nvdb(const InputFile& file, std::size_t number) {
    const NvdbGrid listed = list_nvdb_grids(file).at(number);
    if (listed.bytes < sizeof(nanovdb::GridData) + sizeof(nanovdb::TreeData<3>))
        throw std::runtime_error("damaged: a grid is smaller than its header");
    auto buffer = nanovdb::HostBuffer::create(listed.bytes);
    unpack_nvdb_grid(file, listed, {reinterpret_cast<std::byte*>(buffer.data()), listed.bytes});
    const auto* data = reinterpret_cast<const nanovdb::GridData*>(buffer.data());
    if (static_cast<std::uint32_t>(data->mGridType) != listed.type)
        throw std::runtime_error("damaged: a grid is of another type than the file says");
    RawVolume raw;
    raw.channels = data->mGridType == nanovdb::GridType::Vec3f || data->mGridType == nanovdb::GridType::Vec3d ? 3 : 1;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column)
            raw.world_from_index[row][column] = data->mMap.mMatD[3 * row + column];
        raw.world_from_index[row][3] = data->mMap.mVecD[row];
    }
    raw.world_from_index[3][3] = 1;
    as_typed(listed.type, [&](auto build) { CheckedGrid<typename decltype(build)::type>(buffer).read(raw); });
    return raw;
}

void write_nvdb(std::ostream& out, const DenseVolume& volume) {
    nanovdb::GridBuilder<float> builder(
        volume.background, volume.level_set ? nanovdb::GridClass::LevelSet : nanovdb::GridClass::FogVolume);
    const auto value = [&](const nanovdb::Coord& at) {
        std::size_t place = 0;
        for (int axis = 2; axis >= 0; --axis)
            place = place * static_cast<std::size_t>(volume.size[static_cast<std::size_t>(axis)]) +
                    static_cast<std::size_t>(at[axis] - volume.first[static_cast<std::size_t>(axis)]);
        return volume.values[place];
    };
    nanovdb::Coord low, high;
    double forward[3][4], back[3][3];
    const Mat4 index_from_world = inverse(volume.world_from_index);
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        low[axis] = volume.first[a], high[axis] = volume.first[a] + volume.size[a] - 1;
        for (std::size_t k = 0; k < 4; ++k) forward[axis][k] = volume.world_from_index[a][k];
        for (std::size_t k = 0; k < 3; ++k) back[axis][k] = index_from_world[a][k];
    }
    builder(value, nanovdb::CoordBBox(low, high));
    nanovdb::Map map;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            map.mMatF[3 * row + column] = static_cast<float>(map.mMatD[3 * row + column] = forward[row][column]);
            map.mInvMatF[3 * row + column] = static_cast<float>(map.mInvMatD[3 * row + column] = back[row][column]);
        }
        map.mVecF[row] = static_cast<float>(map.mVecD[row] = forward[row][3]);
    }
    map.mTaperD = 1, map.mTaperF = 1;
    nanovdb::io::writeGrid(out, builder.getHandle(map, volume.grid), nanovdb::io::Codec::ZIP);
}

}  // namespace wrinkle::io
