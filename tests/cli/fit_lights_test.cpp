// wrinkle fit-lights, and runs that fit lights by themselves.
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

const std::string frame = Workplace::data_file("gbuffer/relit.exr") + "\"\nlayer = \"ViewLayer",
                  camera = "file = \"" + Workplace::data_file("gbuffer/relit.camera.json") + "\"",
                  ratio = "[lighting]\nrelight = \"ratio\"\n";

TEST(FitLights, PrintsLightsThatASceneCanUse) {
    const Workplace place;
    place.write_scene(tilt + ratio, frame, camera);
    const Ran printed = place.run("fit-lights scene.toml"), written = place.run("fit-lights scene.toml -o lights.toml");
    EXPECT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(read_text(place / "lights.toml"), printed.out) << "the same frame gives the same lights";
    expect_mentions(printed.out, {"kind = \"sky\"", "kind = \"sun\"", "Unexplained: "});
    expect_mentions(written.out, {"wrote lights.toml: a sky, a sun that travels along [0.7"});
    place.write_scene(tilt + ratio + printed.out, frame, camera);
    EXPECT_EQ(place.run("explain scene.toml --no-source").code, 0);
    expect_failed(place.run("fit-lights scene.toml -o scene.toml"), {"scene.toml"});
    write_text(place / "lamps.csv", "x,y,z\n0,0,3\n");
    place.write_scene(tilt + ratio + "lights = \"lamps.csv\"\n", frame, camera);
    expect_failed(place.run("fit-lights scene.toml -o lamps.csv"), {"lamps.csv"});
    EXPECT_EQ(read_text(place / "lamps.csv"), "x,y,z\n0,0,3\n");
}

TEST(FitLights, ARunWithoutLightsFitsThemAndSaysSo) {
    const Workplace place;
    place.write_scene(tilt + ratio, frame, camera);
    const Ran ran = place.run("run scene.toml -o out");
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_mentions(ran.out, {"lights: fitted to the picture as the scene names none: a sky, a sun"});
    EXPECT_EQ(place.run("explain scene.toml --no-source").code, 0);
}

TEST(FitLights, SaysWhatItLacks) {
    const Workplace place;
    place.write_scene(tilt + ratio, Workplace::data_file("gbuffer/relit.exr") + "\"\nroles = { beauty = \"none\" }  # ",
                      camera);
    expect_failed(place.run("fit-lights scene.toml"), {"relit.exr", "it has no beauty"});
}

}  // namespace
}  // namespace wrinkle::test
