// The only file that includes OpenVDB's headers, since they compile slowly. openvdb.h, which has every type of grid,
// would be the slowest, so it is not included.
// Their templates keep the visibility that OpenVDB's own library has them with. A program that hides some of a class's
// static members, and shares others with that library, crashes when OpenVDB registers its grids.
#pragma GCC visibility push(default)
#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/tree/Tree.h>
#pragma GCC visibility pop

#include <fstream>

#include "io/volume_grid.h"

namespace openvdb {
OPENVDB_USE_VERSION_NAMESPACE
namespace OPENVDB_VERSION_NAME {
OPENVDB_API void initialize();  // declared in openvdb.h
}
}  // namespace openvdb

namespace wrinkle::io {

namespace {

/// A name that opens what is open already, whatever has taken the file's own name since.
std::string name_of_open(const InputFile& file) { return "/proc/self/fd/" + std::to_string(file.descriptor()); }

template <class T>
using GridOf = openvdb::Grid<typename openvdb::tree::Tree4<T, 5, 4, 3>::Type>;
using openvdb::Coord, openvdb::Vec3d, openvdb::Vec3s;

/// Calls `work` with the grid as its own type. False when it is of a type that is not read here.
template <class Work>
bool as_typed(const openvdb::GridBase& grid, const Work& work) {
    const auto as = [&](auto none) {
        using Grid = GridOf<decltype(none)>;
        if (!grid.isType<Grid>()) return false;
        work(static_cast<const Grid&>(grid));
        return true;
    };
    return as(float{}) || as(double{}) || as(Vec3s{}) || as(Vec3d{});
}

std::array<float, 3> numbers(double v) { return {static_cast<float>(v), 0, 0}; }
template <class T>
std::array<float, 3> numbers(const openvdb::math::Vec3<T>& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

template <class Grid>
void read_voxels(const Grid& grid, RawVolume& raw) {
    const auto& tree = grid.tree();
    raw.background = numbers(tree.background());
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) add_leaf(raw, *leaf);
    auto tile = tree.cbeginValueAll();
    tile.setMaxDepth(tile.getLeafDepth() - 1);
    for (; tile; ++tile) {
        if (*tile == tree.background()) continue;
        const openvdb::CoordBBox box = tile.getBoundingBox();
        const auto block = [](const Coord& at) { return std::array{at[0] >> 3, at[1] >> 3, at[2] >> 3}; };
        raw.tiles.push_back({block(box.min()), block(box.max()), numbers(*tile)});
    }
}

/// A grid without blocks that are all background, and with a single value for blocks that are constant.
template <class T>
openvdb::GridBase::Ptr make_grid(const DenseVolume& volume) {
    using Tree = typename GridOf<T>::TreeType;
    const T background(volume.background);
    auto grid = GridOf<T>::create(background);
    const auto value = [&](const Coord& at) -> T {
        std::size_t place = 0;
        for (int axis = 2; axis >= 0; --axis) {
            const int local = at[axis] - volume.first[axis];
            if (local < 0 || local >= volume.size[axis]) return background;
            place = place * static_cast<std::size_t>(volume.size[axis]) + static_cast<std::size_t>(local);
        }
        const float* v = volume.values.data() + place * static_cast<std::size_t>(volume.channels);
        if constexpr (std::is_same_v<T, float>)
            return *v;
        else
            return T(v[0], v[1], v[2]);
    };
    const auto active = [&](const T& v) {
        if constexpr (std::is_same_v<T, float>)
            if (volume.level_set) return std::abs(v) < volume.background;
        return v != background;
    };
    const Coord low(volume.first[0], volume.first[1], volume.first[2]);
    const Coord high = low + Coord(volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1);
    for (auto block = openvdb::CoordBBox(low >> 3, high >> 3).begin(); block; ++block) {
        const Coord origin = *block << 3;
        auto leaf = std::make_unique<typename Tree::LeafNodeType>(origin, background, false);
        for (openvdb::Index i = 0; i < Volume::block_voxels; ++i) {
            const T v = value(leaf->offsetToGlobalCoord(i));
            if (active(v))
                leaf->setValueOn(i, v);
            else
                leaf->setValueOff(i, v);
        }
        T constant;
        bool on = false;
        if (!leaf->isConstant(constant, on))
            grid->tree().addLeaf(leaf.release());
        else if (constant != background)
            grid->tree().addTile(1, origin, constant, on);
    }
    return grid;
}

/// Checks whether a file holds all of its grids. OpenVDB does not notice when it reads past the end of a file, and goes
/// on with sizes that are not there.
class Contents : public openvdb::io::Archive {
public:
    static bool complete(const InputFile& file) {
        std::ifstream in(name_of_open(file), std::ios::binary);
        in.exceptions(std::ios::failbit | std::ios::badbit | std::ios::eofbit);
        try {
            Contents contents;
            contents.readHeader(in);
            contents.setFormatVersion(in);
            openvdb::MetaMap().readMeta(in);
            if (!contents.inputHasGridOffsets()) return true;
            const auto size = static_cast<std::int64_t>(file.size());
            for (auto left = readGridCount(in); left > 0; --left) {
                openvdb::io::GridDescriptor grid;
                grid.read(in);
                if (grid.getEndPos() > size) return false;
                grid.seekToEnd(in);
            }
            return true;
        } catch (const std::ios::failure&) { return false; }
    }
};

/// Writes a file to the caller's stream. openvdb::io::File would hide that a disk is full; openvdb::io::Stream would
/// leave out where in the file each grid is.
class StreamArchive : public openvdb::io::Archive {
public:
    using Archive::write;
};

}  // namespace

std::uint32_t newest_vdb() { return openvdb::OPENVDB_FILE_VERSION; }

std::vector<ListedGrid> list_vdb(const InputFile& file) {
    openvdb::initialize();
    if (!Contents::complete(file)) OPENVDB_THROW(openvdb::IoError, "it ends before its grids do");
    openvdb::io::File in(name_of_open(file));
    in.open(false);
    std::vector<ListedGrid> grids;
    for (auto name = in.beginName(); name != in.endName(); ++name) {
        const openvdb::GridBase::Ptr grid = in.readGridMetadata(*name);
        grids.push_back({*name, grid->valueType(), as_typed(*grid, [](const auto&) {})});
    }
    return grids;
}

RawVolume read_vdb(const InputFile& file, const std::string& name, bool voxels) {
    openvdb::initialize();
    openvdb::io::File in(name_of_open(file));
    in.open(false);  // false: voxels are read now, not when they are first used
    const openvdb::GridBase::Ptr grid = voxels ? in.readGrid(name) : in.readGridMetadata(name);
    RawVolume raw;
    raw.channels = grid->isType<GridOf<Vec3s>>() || grid->isType<GridOf<Vec3d>>() ? 3 : 1;
    raw.affine = grid->transform().isLinear();
    if (raw.affine) {
        const openvdb::Mat4d m = grid->transform().baseMap()->getAffineMap()->getMat4();  // acts on row vectors
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column)
                raw.world_from_index[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] = m(column, row);
    }
    if (voxels) as_typed(*grid, [&](const auto& typed) { read_voxels(typed, raw); });
    return raw;
}

void write_vdb(std::ostream& out, const DenseVolume& volume) {
    openvdb::initialize();
    const openvdb::GridBase::Ptr grid = volume.channels == 3 ? make_grid<Vec3s>(volume) : make_grid<float>(volume);
    openvdb::Mat4d m;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            m(column, row) = volume.world_from_index[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    grid->setTransform(openvdb::math::Transform::createLinearTransform(m));
    grid->setName(volume.grid);
    grid->setGridClass(volume.level_set       ? openvdb::GRID_LEVEL_SET
                       : volume.channels == 3 ? openvdb::GRID_UNKNOWN
                                              : openvdb::GRID_FOG_VOLUME);
    grid->setSaveFloatAsHalf(volume.half);
    StreamArchive().write(out, openvdb::GridPtrVec{grid}, true);
}

}  // namespace wrinkle::io
