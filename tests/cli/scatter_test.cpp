// wrinkle scatter: decals on a frame, from the command line.
#include "tests/cli/cli.h"
#include "wrinkle/scene.h"

namespace wrinkle::test {
namespace {

const std::string frame = Workplace::data_file("gbuffer/small.exr");

TEST(Scatter, WritesATableThatASceneCanUse) {
    const Workplace place;
    place.write_scene("");
    const Ran ran = place.run("scatter scene.toml -o d.csv --count 20 --shapes sphere cone --opacity 0.5 --replace");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out, "wrote d.csv: 20 decals\n");
    const std::string table = read_text(place / "d.csv");
    expect_mentions(table, {"sphere", "cone", "replace"});
    EXPECT_EQ(table.find("box"), std::string::npos);
    place.write_scene("[[layer]]\nkind = \"decals\"\nfile = \"d.csv\"\ntextures = [{ file = \"" +
                      Workplace::data_file("textures/seal_height.png") + "\" }]\n");
    EXPECT_EQ(place.run("explain scene.toml --no-source").code, 0);
    const std::string arguments = " --count 20 --shapes sphere cone --opacity 0.5 --replace";
    EXPECT_EQ(place.run("scatter scene.toml -o d.toml" + arguments).code, 0);
    const auto rows = load_decals(place / "d.csv", 1), same = load_decals(place / "d.toml", 1);
    ASSERT_EQ(same.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_EQ(same[i].center, rows[i].center);
        EXPECT_EQ(same[i].axis_x, rows[i].axis_x);
        EXPECT_EQ(same[i].half_size, rows[i].half_size);
        EXPECT_EQ(same[i].shape, rows[i].shape);
    }
}

TEST(Scatter, TakesTheGeometryThatTheSceneNames) {
    const Workplace place;
    const auto table = [&](const std::string& gbuffer) {
        place.write_scene("", frame + "\"\n" + gbuffer + "  # ");
        const Ran ran = place.run("scatter scene.toml -o d.csv --count 20");
        EXPECT_EQ(ran.code, 0) << ran.err;
        return read_text(place / "d.csv");
    };
    const std::string wrong_depth = "roles = { depth = \"ViewLayer.Normal.Z\" }\n";
    const std::string positions = table("roles = { depth = \"none\" }\n");
    EXPECT_EQ(table(wrong_depth + "geometry = \"position\"\n"), positions);
    EXPECT_NE(table(wrong_depth), positions);
    EXPECT_NE(table("geometry = \"depth\"\n"), positions) << "they agree but for their last digits";
}

TEST(Scatter, NumbersThatAreNoneAreRefused) {
    const Workplace place;
    place.write_scene("");
    for (const auto& [option, parts] : std::map<std::string, std::vector<std::string>>{
             {"--size nan nan", {"--size", "\"nan\"", "greater than 0"}},
             {"--size inf inf", {"--size", "\"inf\" is given; expected a finite number"}},
             {"--depth nan", {"--depth", "\"nan\"", "finite"}},
             {"--spacing nan", {"--spacing", "\"nan\"", "at least 0"}},
             {"--spacing -1", {"--spacing", "\"-1\"", "at least 0"}},
             {"--opacity nan", {"--opacity", "from 0 to 1"}},
             {"--thickness 0", {"--thickness", "\"0\"", "greater than 0"}},
             {"--shapes pyramid", {"--shapes", "\"pyramid\"", "\"box\", \"cone\", \"sphere\""}}}) {
        const Ran ran = place.run("scatter scene.toml -o d.csv " + option);
        EXPECT_EQ(ran.code, 2) << option;
        expect_failed(ran, parts);
    }
    EXPECT_FALSE(fs::exists(place / "d.csv"));
    EXPECT_EQ(place.run("scatter --help").out.find("->"), std::string::npos);
}

TEST(Scatter, FramesWithoutASurfaceOrWithAnotherCameraAreRefused) {
    const Workplace place;
    place.write_scene("", frame, "eye = [0, -6, 4]\ntarget = [0, 0, 0]\nfov = 40");
    expect_failed(place.run("scatter scene.toml -o d.csv"), {"small.exr", "pixels away"});
    write_exr(place / "sky.exr", 8, 6, {"Depth.Z", "Normal.X", "Normal.Y", "Normal.Z"},
              [](int c, int, int) { return c == 0 ? 1e10f : 0.0f; });
    place.write_scene("", "sky.exr", "eye = [0, -6, 4]\ntarget = [0, 0, 0]\nfov = 40");
    expect_failed(place.run("scatter scene.toml -o d.csv"), {"no pixel of the frame shows a surface"});
    EXPECT_FALSE(fs::exists(place / "d.csv"));
}

}  // namespace
}  // namespace wrinkle::test
