// Volumes that OpenVDB crashes over, or that ask for more than there is: one clear line, soon.
#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/tree/Tree.h>

#include <chrono>
#include <random>

#include "io/volume_file.h"
#include "tests/cli/cli.h"
#include "wrinkle/limits.h"

namespace wrinkle::test {
namespace {

using Grid = openvdb::Grid<openvdb::tree::Tree4<float, 5, 4, 3>::Type>;

/// Reads by the built program from here on, as the command does.
class ByAnotherProcess {
public:
    ByAnotherProcess() { set_limits({.memory = 0, .sandbox = {}, .volume_reader = WRINKLE_CLI}); }
    ~ByAnotherProcess() { set_limits({}); }
    ByAnotherProcess(const ByAnotherProcess&) = delete;
    ByAnotherProcess& operator=(const ByAnotherProcess&) = delete;
};

std::string outcome(const fs::path& file) {
    try {
        load_volume(file, "");
    } catch (const Error& error) { return error.what(); }
    return {};
}

template <class Fill>
void write_grid(const fs::path& file, const Fill& fill) {
    auto grid = Grid::create(3);
    grid->setName("g");
    fill(grid->tree());
    openvdb::io::File out(file.string());
    out.write({grid});
    out.close();
}

TEST(Volumes, AreTheSameFromAnotherProcess) {
    const fs::path file = Workplace::data_file("volumes/noise.vdb");
    const Volume here = load_volume(file, "");
    const ByAnotherProcess child;
    const Volume there = load_volume(file, "");
    EXPECT_EQ(here.voxels, there.voxels);
    EXPECT_EQ(here.blocks, there.blocks);
    EXPECT_EQ(here.constants, there.constants);
    EXPECT_EQ(here.info.index_from_world, there.info.index_from_world);
    EXPECT_EQ(volume_info(file, "").grid, here.info.grid);
    expect_mentions(error_of([&] { load_volume(file, "none"); }), {"noise.vdb: there is no grid \"none\"", "grids: "});
}

TEST(Volumes, ThatCrashOpenVDBAreErrors) {
    const ByAnotherProcess child;
    const std::string text = outcome(Workplace::data_file("volumes/damaged.vdb"));
    expect_mentions(text, {"damaged.vdb: cannot be read", "truncated or damaged"});
    EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(Volumes, AreDamagedInManyWays) {
    const TempFolder folder;
    const std::string bytes = read_text(Workplace::data_file("volumes/damaged.vdb"));
    const ByAnotherProcess child;
    std::mt19937 random(4);
    for (int trial = 0; trial < 20; ++trial) {
        std::string changed = bytes;
        for (int i = 0; i < 8; ++i) changed[random() % changed.size()] = static_cast<char>(random());
        write_text(folder / "a.vdb", changed);
        const std::string text = outcome(folder / "a.vdb");
        if (!text.empty()) { EXPECT_EQ(text.find(folder / "a.vdb"), 0u) << text; }
    }
}

/// Few bytes that span many blocks: taken where their index is small, else refused by their size.
TEST(Volumes, OfFewBytesTakeLittleTime) {
    const TempFolder folder;
    load_volume(Workplace::data_file("volumes/noise.vdb"), "");  // so that OpenVDB has registered its types
    write_grid(folder / "tile.vdb", [](auto& tree) { tree.addTile(3, {0, 0, 0}, 1.0F, true); });
    write_grid(folder / "far.vdb", [](auto& tree) { tree.setValue({0, 0, 0}, 1), tree.setValue({1 << 30, 0, 0}, 1); });
    write_grid(folder / "diagonal.vdb", [](auto& tree) {
        tree.setValue({0, 0, 0}, 1), tree.setValue({1600, 1600, 1600}, 1);
    });
    expect_mentions(outcome(folder / "tile.vdb"), {"spans 4096 x 4096 x 4096 voxels", "crop or resample it"});
    expect_mentions(outcome(folder / "far.vdb"), {"spans 1073741832 x 8 x 8 voxels", "crop or resample it"});
    EXPECT_EQ(outcome(folder / "diagonal.vdb"), "");
}

}  // namespace
}  // namespace wrinkle::test
