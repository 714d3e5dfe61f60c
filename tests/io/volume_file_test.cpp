#include "io/volume_file.h"

#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tree/Tree.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tests/io/files.h"
#include "tests/reference/volume.h"

namespace wrinkle {
namespace {

using namespace test;
namespace fs = std::filesystem;

/// A box of voxels that are all different. It spans several blocks, and indices on both sides of zero.
DenseVolume box() {
    DenseVolume volume;
    volume.first = {-5, 3, -20}, volume.size = {21, 9, 30};
    for (int i = 0; i < 21 * 9 * 30; ++i)
        volume.values.push_back(std::sin(0.37f * static_cast<float>(i)) + 0.01f * static_cast<float>(i % 17));
    volume.background = 0.25f;
    volume.world_from_index = {{{0.5, 0.1, 0, 3}, {0, 0.4, -0.2, -1}, {0.05, 0, 0.3, 2}, {0, 0, 0, 1}}};
    return volume;
}

float voxel(const DenseVolume& v, int x, int y, int z, int channel = 0) {
    const int at[] = {x - v.first[0], y - v.first[1], z - v.first[2]};
    for (std::size_t k = 0; k < 3; ++k)
        if (at[k] < 0 || at[k] >= v.size[k]) return v.background;
    const int place = (at[2] * v.size[1] + at[1]) * v.size[0] + at[0];
    return v.values[static_cast<std::size_t>(place * v.channels + channel)];
}

void expect_same(const DenseVolume& wrote, const Volume& read) {
    ASSERT_EQ(read.info.channels, wrote.channels);
    for (int z = wrote.first[2] - 20; z < wrote.first[2] + wrote.size[2] + 20; ++z)
        for (int y = wrote.first[1] - 20; y < wrote.first[1] + wrote.size[1] + 20; ++y)
            for (int x = wrote.first[0] - 20; x < wrote.first[0] + wrote.size[0] + 20; ++x)
                for (int c = 0; c < wrote.channels; ++c)
                    ASSERT_EQ(read.at(x, y, z, c), voxel(wrote, x, y, z, c)) << x << " " << y << " " << z;
}

std::string refusal(const fs::path& file, const std::string& grid = {}) {
    try {
        load_volume(file, grid);
    } catch (const Error& error) { return error.what(); }
    return "nothing was refused";
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in: " << text;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const fs::path& file, const std::string& bytes) { std::ofstream(file, std::ios::binary) << bytes; }

template <class T>
using GridOf = openvdb::Grid<typename openvdb::tree::Tree4<T, 5, 4, 3>::Type>;

void write_grids(const fs::path& file, const openvdb::GridPtrVec& grids) {
    openvdb::io::File out(file.string());
    out.write(grids);
    out.close();
}

template <class T>
typename GridOf<T>::Ptr grid_of(const std::string& name, T value) {
    auto grid = GridOf<T>::create();
    grid->setName(name);
    grid->tree().setValue({1, 2, 3}, value);
    return grid;
}

TEST(VolumeFile, VoxelsAndTransformComeBack) {
    TempFolder folder;
    const DenseVolume volume = box();
    for (const char* name : {"a.vdb", "a.nvdb"}) {
        save_volume(folder / name, volume);
        const Volume read = load_volume(folder / name, "");
        expect_same(volume, read);
        EXPECT_EQ(read.info.grid, "density");
        for (const VolumeInfo& info : {read.info, volume_info(folder / name, "density")}) {
            const Mat4 unit = multiply(info.index_from_world, volume.world_from_index);
            for (std::size_t i = 0; i < 4; ++i)
                for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(unit[i][k], i == k ? 1 : 0, 1e-12) << name;
        }
    }
}

TEST(VolumeFile, HalfFloatsAreRounded) {
    TempFolder folder;
    DenseVolume volume = box();
    volume.half = true;
    save_volume(folder / "half.vdb", volume);
    EXPECT_NEAR(load_volume(folder / "half.vdb", "").at(0, 5, -3, 0), voxel(volume, 0, 5, -3), 1e-3);
}

TEST(VolumeFile, VectorsComeBack) {
    TempFolder folder;
    DenseVolume volume = box();
    volume.channels = 3;
    std::vector<float> vectors;
    for (const float v : volume.values) vectors.insert(vectors.end(), {v, 2 * v, 1 - v});
    volume.values = vectors;
    save_volume(folder / "v.vdb", volume);
    expect_same(volume, load_volume(folder / "v.vdb", ""));
}

/// The inside of a level set, and boxes of a single value, are stored as tiles.
TEST(VolumeFile, ConstantRegionsComeBack) {
    TempFolder folder;
    DenseVolume volume;
    volume.level_set = true, volume.background = 3;
    volume.first = {-40, -40, -40}, volume.size = {80, 80, 80};
    for (int i = 0; i < 80 * 80 * 80; ++i) {
        const double r = std::hypot(i % 80 - 40, i / 80 % 80 - 40, i / 6400 - 40) - 30;
        volume.values.push_back(static_cast<float>(std::clamp(r, -3.0, 3.0)));
    }
    volume.world_from_index = box().world_from_index;
    for (const char* name : {"a.vdb", "a.nvdb"}) {
        save_volume(folder / name, volume);
        expect_same(volume, load_volume(folder / name, ""));
    }
    auto filled = grid_of<float>("filled", 1);
    filled->tree().addTile(2, {300, 0, 0}, 7.0f, false);
    write_grids(folder / "tiles.vdb", {filled});
    const Volume read = load_volume(folder / "tiles.vdb", "");
    EXPECT_EQ(read.at(1, 2, 3, 0), 1);
    EXPECT_EQ(read.at(256, 0, 0, 0), 7);
    EXPECT_EQ(read.at(383, 127, 127, 0), 7);
    EXPECT_EQ(read.at(384, 0, 0, 0), 0);
}

TEST(VolumeFile, DoublesBecomeFloats) {
    TempFolder folder;
    write_grids(folder / "d.vdb", {grid_of<double>("d", 0.1)});
    EXPECT_EQ(load_volume(folder / "d.vdb", "").at(1, 2, 3, 0), 0.1f);
}

/// The references that kernels are tested against must give the same as OpenVDB's own samplers.
TEST(VolumeFile, ReferencesAgreeWithTheSamplersOfOpenVDB) {
    TempFolder folder;
    const DenseVolume volume = box();
    save_volume(folder / "a.vdb", volume);
    openvdb::io::File in((folder / "a.vdb").string());
    in.open(false);
    const auto grid = openvdb::gridPtrCast<GridOf<float>>(in.readGrid("density"));
    const Volume read = load_volume(folder / "a.vdb", "");
    const reference::Voxels<double> voxels = [&](int x, int y, int z) { return double(read.at(x, y, z, 0)); };
    for (int i = 0; i < 500; ++i) {
        const double x = -6 + 0.043 * i, y = 2 + 0.019 * i, z = -21 + 0.061 * i, step = 1e-3;
        const auto sample = [&](double dx, double dy, double dz) {
            return double(openvdb::tools::BoxSampler::sample(grid->tree(), openvdb::Vec3d(x + dx, y + dy, z + dz)));
        };
        const auto want = reference::trilinear<double>(voxels, {x, y, z});
        EXPECT_NEAR(sample(0, 0, 0), want.value, 1e-6);
        const bool inside = std::abs(x - std::round(x)) > step && std::abs(y - std::round(y)) > step &&
                            std::abs(z - std::round(z)) > step;
        if (!inside) continue;  // on faces of cells the slope jumps
        EXPECT_NEAR((sample(step, 0, 0) - sample(-step, 0, 0)) / (2 * step), want.gradient.x, 1e-3);
        EXPECT_NEAR((sample(0, step, 0) - sample(0, -step, 0)) / (2 * step), want.gradient.y, 1e-3);
        EXPECT_NEAR((sample(0, 0, step) - sample(0, 0, -step)) / (2 * step), want.gradient.z, 1e-3);
    }
}

TEST(VolumeFile, WhatIsNoVolumeIsRefused) {
    TempFolder folder;
    write_bytes(folder / "text.vdb", "this is no volume at all");
    write_bytes(folder / "empty.vdb", "");
    expect_refused(refusal(folder / "text.vdb"), {"text.vdb", "neither an OpenVDB (.vdb) nor a NanoVDB (.nvdb) file"});
    expect_refused(refusal(folder / "empty.vdb"), {"neither an OpenVDB"});
    expect_refused(refusal(folder / "none.vdb"), {"none.vdb: there is no such file"});
    expect_refused(refusal(folder / "."), {"is a folder"});
}

TEST(VolumeFile, NewerVersionsAndDamageAreRefused) {
    TempFolder folder;
    for (const char* name : {"a.vdb", "a.nvdb"}) {
        save_volume(folder / name, box());
        const std::string good = bytes_of(folder / name);
        std::string newer = good;
        const std::uint32_t version = name[2] == 'v' ? 999 : 40u << 21;
        std::memcpy(newer.data() + 8, &version, sizeof version);
        write_bytes(folder / name, newer);
        expect_refused(refusal(folder / name), {"version", name[2] == 'v' ? "999" : "40", "can be read"});
        for (const double share : {0.02, 0.5, 0.95}) {
            write_bytes(folder / name,
                        good.substr(0, static_cast<std::size_t>(share * static_cast<double>(good.size()))));
            SCOPED_TRACE(share);
            expect_refused(refusal(folder / name),
                           {"cannot be read", name[2] == 'v' ? "it ends before its grids do" : "damaged"});
        }
    }
}

TEST(VolumeFile, DamageIsToldOnOneLine) {
    TempFolder folder;
    save_volume(folder / "a.vdb", box());
    std::string bytes = bytes_of(folder / "a.vdb");
    const std::size_t map = bytes.find("AffineMap");
    ASSERT_NE(map, std::string::npos);
    bytes[map] = '\n';
    write_bytes(folder / "a.vdb", bytes);
    const std::string text = refusal(folder / "a.vdb");
    expect_refused(text, {"a.vdb: cannot be read; it may be truncated or damaged"});
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
}

TEST(VolumeFile, MissingAndWrongGridsAreToldWithWhatThereIs) {
    TempFolder folder;
    save_volume(folder / "a.vdb", box());  // so that OpenVDB has registered its types
    write_grids(folder / "b.vdb", {grid_of<float>("density", 1), grid_of<float>("heat", 1), grid_of<int>("ids", 1)});
    const fs::path file = folder / "b.vdb";
    expect_refused(refusal(file, "densty"),
                   {"no grid \"densty\"; did you mean \"density\"?", "\"heat\" (float)", "\"ids\" (int32)"});
    expect_refused(refusal(file, "ids"), {"\"ids\" holds int32", "float, double or 3-vectors", "\"density\" (float)"});
    expect_refused(refusal(file), {"several grids", "\"grid\"", "\"density\" (float), \"heat\" (float)"});
    EXPECT_EQ(load_volume(file, "heat").at(1, 2, 3, 0), 1);
    write_grids(folder / "c.vdb", {grid_of<int>("ids", 1)});
    expect_refused(refusal(folder / "c.vdb"), {"holds no grid of float", "\"ids\" (int32)"});
}

TEST(VolumeFile, EmptyGridsAndBadVoxelsAreRefused) {
    TempFolder folder;
    save_volume(folder / "a.vdb", box());
    auto empty = GridOf<float>::create(2.0f);
    empty->setName("nothing");
    write_grids(folder / "e.vdb", {empty});
    expect_refused(refusal(folder / "e.vdb"), {"\"nothing\" is empty"});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    write_grids(folder / "n.vdb", {grid_of<float>("n", nan)});
    expect_refused(refusal(folder / "n.vdb"), {"1 numbers", "NaN", "(1, 2, 3)"});
    write_grids(folder / "h.vdb", {grid_of<double>("h", 1e300)});
    expect_refused(refusal(folder / "h.vdb"), {"beyond float", "(1, 2, 3)"});
    auto wide = grid_of<float>("wide", 1);
    wide->tree().setValue({1 << 24, 1 << 24, 1 << 24}, 1);
    write_grids(folder / "w.vdb", {wide});
    expect_refused(refusal(folder / "w.vdb"), {"spans 16777", "crop or resample"});
}

TEST(VolumeFile, TransformsThatCannotBeInvertedAreRefused) {
    TempFolder folder;
    save_volume(folder / "a.vdb", box());
    auto frustum = grid_of<float>("f", 1);
    frustum->setTransform(
        openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {100, 100, 100}), 0.5, 10, 0.1));
    write_grids(folder / "f.vdb", {frustum});
    expect_refused(refusal(folder / "f.vdb"), {"\"f\"", "frustum"});
    const double size = 0.123456789;
    auto flat = grid_of<float>("flat", 1);
    flat->setTransform(openvdb::math::Transform::createLinearTransform(size));
    write_grids(folder / "flat.vdb", {flat});
    std::string bytes = bytes_of(folder / "flat.vdb");
    const std::string pattern(reinterpret_cast<const char*>(&size), sizeof size), zero(sizeof size, '\0');
    int found = 0;
    for (std::size_t at = 0; (at = bytes.find(pattern, at)) != std::string::npos; ++found) bytes.replace(at, 8, zero);
    ASSERT_GT(found, 0);
    write_bytes(folder / "flat.vdb", bytes);
    EXPECT_NE(refusal(folder / "flat.vdb"), "nothing was refused");
    EXPECT_TRUE(is_singular({{{1, 2, 0, 0}, {2, 4, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}));
    EXPECT_TRUE(is_singular({}));
    EXPECT_FALSE(is_singular({{{1e-6, 0, 0, 0}, {0, 1e-6, 0, 0}, {0, 0, -1e-6, 0}, {0, 0, 0, 1}}}));
}

}  // namespace
}  // namespace wrinkle
