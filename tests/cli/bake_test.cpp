// Volumes from the command line: baked, used in a scene, refused.
#include "io/volume_file.h"
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

std::string volume(const std::string& file, const std::string& rest = {}) {
    return "[[layer]]\nname = \"fog\"\nkind = \"volume\"\nvolume = \"" + file + "\"\n" + rest;
}

TEST(Bake, VolumesCanBeUsed) {
    const Workplace place;
    for (const char* file : {"g.vdb", "g.nvdb"}) {
        const Ran ran = place.run(std::string("bake-volume golden --size 24 -o ") + file);
        ASSERT_EQ(ran.code, 0) << ran.err;
        EXPECT_EQ(load_volume(place / file, "golden").info.channels, 1);
    }
    EXPECT_EQ(place.run("bake-volume golden-gradient --size 16 -o v.vdb").code, 0);
    EXPECT_EQ(place.run("bake-volume noise --size 16 -o n.vdb").code, 0);
    EXPECT_EQ(load_volume(place / "v.vdb", "").info.channels, 3);
    place.write_scene(volume("g.nvdb", "remap = \"wave\"\n") + volume("n.vdb").replace(18, 3, "mud") +
                      volume("v.vdb").replace(18, 3, "run"));
    const Ran run = place.run("run scene.toml -o out");
    EXPECT_EQ(run.code, 0) << run.err;
    const Ran explained = place.run("explain scene.toml");
    expect_mentions(explained.out, {"volume \"fog\"", "wr_volume_trilinear", "wr_volume_vector", "wr_shape_wave",
                                    "\"golden\" of values: ", "of vectors: ", "MB on the device"});
    expect_mentions(place.run("explain --json scene.toml").out, {"\"volumes\"", "\"grid\": \"golden\"", "\"stored\""});
}

TEST(Bake, VolumesCanBeSampled) {
    const Workplace place;
    ASSERT_EQ(place.run("bake-volume noise --size 16 -o n.vdb").code, 0);
    write_text(place / "p.csv", "p.x,p.y,p.z\n3.5,4,5\n");
    const Ran ran = place.run("eval volume_trilinear --set volume=n.vdb --in p.csv --out v.csv");
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_mentions(read_text(place / "v.csv"), {"value", "gradient.z"});
    expect_failed(place.run("eval volume_trilinear --set volume=p.csv --in p.csv --out v.csv"),
                  {"p.csv", "neither an OpenVDB"});
}

TEST(Bake, FrameHasWhatAFrameNeeds) {
    const Workplace place;
    const Ran ran = place.run("bake-frame --width 48 --height 32 -o golden.exr");
    ASSERT_EQ(ran.code, 0) << ran.err;
    place.write_scene(tilt, "golden.exr", "file = \"golden.camera.json\"");
    const Ran run = place.run("run scene.toml -o out");
    EXPECT_EQ(run.code, 0) << run.err;
    expect_mentions(run.out, {"positions reproject within ", "e-0"});
}

TEST(Bake, BadVolumesAreToldWithTheirLayer) {
    const Workplace place;
    write_text(place / "text.vdb", "no volume");
    place.write_scene(volume("text.vdb"));
    expect_failed(place.run("run scene.toml -o out"),
                  {"scene.toml:5: layer \"fog\"", "text.vdb", "neither an OpenVDB"});
    ASSERT_EQ(place.run("bake-volume noise --size 16 -o n.vdb").code, 0);
    place.write_scene(volume("n.vdb", "grid = \"densiti\"\n"));
    expect_failed(place.run("run scene.toml -o out"), {"did you mean \"density\"?", "grids: \"density\" (float)"});
    const std::string good = read_text(place / "n.vdb");
    write_text(place / "cut.vdb", good.substr(0, good.size() / 2));
    place.write_scene(volume("cut.vdb"));
    expect_failed(place.run("run scene.toml -o out"), {"cut.vdb", "it may be truncated or damaged"});
    expect_failed(place.run("bake-volume noise -o no/such/n.vdb"), {"cannot write no/such/n.vdb", "no folder no/such"});
    expect_failed(place.run("bake-volume clouds -o n.vdb"), {"clouds"});
}

TEST(Bake, NamesThatDoNotFitAreRefused) {
    const Workplace place;
    expect_failed(place.run("bake-volume noise -o g.txt"), {"g.txt", "use .vdb or .nvdb"});
    expect_failed(place.run("bake-volume golden-gradient -o g.nvdb"), {"g.nvdb", "vectors", ".vdb only"});
    expect_failed(place.run("bake-frame --width 48 --height 32 -o g.png"), {"g.png", "use .exr"});
    EXPECT_TRUE(place.files("").empty());
    EXPECT_EQ(place.run("bake-volume golden --size 16 -o G.NVDB").code, 0);
    EXPECT_EQ(read_text(place / "G.NVDB").substr(0, 7), "NanoVDB");
}

TEST(Bake, AFullDiskLeavesTheOldFilesAsTheyWere) {
    const Workplace place;
    // The compiler writes files, too: this leaves its kernels in the cache.
    ASSERT_EQ(place.run("bake-frame --width 96 --height 64 -o g.exr").code, 0);
    const std::vector<std::string> names{"g.camera.json", "g.exr", "g.nvdb", "g.vdb"};
    for (const std::string& name : names) write_text(place / name, "old");
    for (const auto& [arguments, file] :
         std::map<std::string, std::string>{{"bake-volume golden --size 32 -o g.vdb", "g.vdb"},
                                            {"bake-volume golden --size 32 -o g.nvdb", "g.nvdb"},
                                            {"bake-frame --width 96 --height 64 -o g.exr", "g.exr"}})
        for (const int blocks : {1, 10}) {  // of 512 bytes
            expect_failed(place.run(arguments, fmt::format("ulimit -f {};", blocks)),
                          {"cannot write " + file, "File too large", "the old file is unchanged"});
            EXPECT_EQ(place.files(""), names);
            for (const std::string& name : names) EXPECT_EQ(read_text(place / name), "old") << arguments;
        }
}

}  // namespace
}  // namespace wrinkle::test
