// The only file that includes NanoVDB's headers, besides the benchmark that races against it.
#define NANOVDB_USE_BLOSC
#define NANOVDB_USE_ZIP
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>

#include "io/volume_grid.h"

namespace wrinkle::io {

namespace {

namespace fs = std::filesystem;

std::array<float, 3> numbers(double v) { return {static_cast<float>(v), 0, 0}; }
template <class T>
std::array<float, 3> numbers(const nanovdb::Vec3<T>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

template <class T>
void add_tile(RawVolume& raw, const nanovdb::Coord& first, int size, const T& value, const T& background) {
    if (value == background) return;
    raw.tiles.push_back({{first[0] >> 3, first[1] >> 3, first[2] >> 3},
                         {(first[0] + size - 1) >> 3, (first[1] + size - 1) >> 3, (first[2] + size - 1) >> 3},
                         numbers(value)});
}

template <class Node, class T>
void add_tiles(RawVolume& raw, const Node* node, std::uint32_t count, const T& background) {
    for (std::uint32_t k = 0; k < count; ++k)
        for (std::uint32_t i = 0; i < Node::SIZE; ++i)
            if (!node[k].data()->isChild(i))
                add_tile(raw, node[k].offsetToGlobalCoord(i), Node::ChildNodeType::DIM, node[k].data()->getValue(i),
                         background);
}

template <class Build>
void read_voxels(const nanovdb::NanoGrid<Build>& grid, RawVolume& raw) {
    const auto& tree = grid.tree();
    const auto background = tree.background();
    raw.background = numbers(background);
    const auto* root = tree.root().data();
    for (std::uint32_t i = 0; i < root->mTableSize; ++i)
        if (const auto* tile = root->tile(i); !tile->isChild())
            add_tile(raw, tile->origin(), nanovdb::NanoUpper<Build>::DIM, tile->value, background);
    add_tiles(raw, tree.template getFirstNode<2>(), tree.nodeCount(2), background);
    add_tiles(raw, tree.template getFirstNode<1>(), tree.nodeCount(1), background);
    const auto* leaf = tree.getFirstLeaf();
    for (std::uint32_t k = 0; k < tree.nodeCount(0); ++k) add_leaf(raw, leaf[k]);
}

}  // namespace

std::uint32_t nvdb_version() { return NANOVDB_MAJOR_VERSION_NUMBER; }

std::vector<ListedGrid> list_nvdb(const fs::path& file) {
    using nanovdb::GridType;
    std::vector<ListedGrid> grids;
    for (const auto& meta : nanovdb::io::readGridMetaData(file.string())) {
        bool usable = false;
        for (const GridType type : {GridType::Float, GridType::Double, GridType::Vec3f, GridType::Vec3d, GridType::Fp4,
                                    GridType::Fp8, GridType::Fp16, GridType::FpN})
            usable |= meta.gridType == type;
        grids.push_back({meta.gridName, nanovdb::toStr(meta.gridType), usable});
    }
    return grids;
}

RawVolume read_nvdb(const fs::path& file, std::size_t number) {
    const auto handle = nanovdb::io::readGrid(file.string(), number);
    RawVolume raw;
    const nanovdb::GridMetaData* meta = handle.gridMetaData();
    raw.channels = meta->gridType() == nanovdb::GridType::Vec3f || meta->gridType() == nanovdb::GridType::Vec3d ? 3 : 1;
    const nanovdb::Map& map = meta->map();
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column)
            raw.world_from_index[row][column] = map.mMatD[3 * row + column];
        raw.world_from_index[row][3] = map.mVecD[row];
    }
    raw.world_from_index[3][3] = 1;
    const auto as = [&](auto build) {
        using Build = typename decltype(build)::type;
        const auto* grid = handle.grid<Build>();
        if (grid) read_voxels<Build>(*grid, raw);
        return grid != nullptr;
    };
    as(std::type_identity<float>{}) || as(std::type_identity<double>{}) || as(std::type_identity<nanovdb::Vec3f>{}) ||
        as(std::type_identity<nanovdb::Vec3d>{}) || as(std::type_identity<nanovdb::Fp4>{}) ||
        as(std::type_identity<nanovdb::Fp8>{}) || as(std::type_identity<nanovdb::Fp16>{}) ||
        as(std::type_identity<nanovdb::FpN>{});
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
