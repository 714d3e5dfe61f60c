// Lights of JSON files, as the Blender exporter writes them.
#include "layers/kinds.h"
#include "tests/scene/scene_folder.h"
#include "tools/frame_lights.h"

namespace wrinkle {
namespace {

class LightJson : public SceneFolder {
protected:
    const std::string lit_ = "[lighting]\nrelight = \"lit\"\nlights = \"frame.lights.json\"\n";

    void expect_refused(const std::string& json, const std::vector<std::string>& parts) const {
        write("frame.lights.json", json);
        std::string all;
        for (const std::string& problem : problems(frame_ + lit_)) all += problem + "\n";
        for (const std::string& part : parts) EXPECT_NE(all.find(part), std::string::npos) << part << "\n" << all;
    }
};

TEST_F(LightJson, HoldsWhatLightsOfTheSceneHold) {
    write("frame.lights.json", R"({"lights": [
        {"kind": "sun", "direction": [0, 0, -2], "intensity": 3, "color": [1, 0.5, 0.25], "picture": "Combined_sun"},
        {"kind": "spot", "position": [1, 2, 3], "direction": [0, 0, -1], "inner_angle": 10, "outer_angle": 20.5,
         "range": null}]})");
    const Scene scene = load_with(lit_ + "[[light]]\nkind = \"point\"\nposition = [4, 5, 6]\n");
    const std::vector<Light>& lights = scene.lighting.lights;
    ASSERT_EQ(lights.size(), 3u) << "beside those of the scene";
    EXPECT_EQ(lights[0].kind, LightKind::point);
    EXPECT_EQ(lights[1].kind, LightKind::sun);
    EXPECT_EQ(lights[1].direction, (Vec3{0, 0, -1}));
    EXPECT_EQ(lights[1].intensity, 3);
    EXPECT_EQ(lights[1].color, (Vec3{1, 0.5, 0.25}));
    EXPECT_EQ(lights[1].picture, "Combined_sun");
    EXPECT_EQ(lights[2].kind, LightKind::spot);
    EXPECT_NEAR(lights[2].outer_angle, 20.5 * degree, 1e-15);
    EXPECT_FALSE(lights[2].range);
    EXPECT_FALSE(scene.lighting.table);
    check(scene);
}

TEST_F(LightJson, IsThatOfTheFrame) {
    write("frame.0007.lights.json", R"({"lights": [{"kind": "sun", "direction": [0, 0, -1], "intensity": 7}]})");
    const std::string text = frame_ + "[lighting]\nrelight = \"lit\"\nlights = \"frame.####.lights.json\"\n";
    const scene::SceneFile file = load_scene_file(write("courtyard.toml", text), {.set = {}, .frame = 7});
    ASSERT_EQ(file.scene.lighting.lights.size(), 1u);
    EXPECT_EQ(file.scene.lighting.lights[0].intensity, 7);
}

TEST_F(LightJson, MaySayThatAFrameHasNoLights) {
    write("frame.lights.json", R"({"lights": []})");
    check(load_with(lit_));
    const Scene scene = load_with("[lighting]\nrelight = \"ratio\"\nlights = \"frame.lights.json\"\n");
    EXPECT_TRUE(scene.lighting.lights.empty());
    EXPECT_FALSE(wants_lights(scene)) << "and none are fitted";
    check(scene);
}

TEST_F(LightJson, TellsWhichLightIsWrong) {
    const std::string sun = R"({"kind": "sun", "direction": [0, 0, -1]})";
    expect_refused("{\"lights\": [" + sun + R"(, {"kind": "sun", "direction": [0, 0, 0]}]})",
                   {"courtyard.toml:7: ", "\"direction\" in light 2 of ", "frame.lights.json", "must not be zero"});
    expect_refused(R"({"lights": [{"kind": "point"}]})", {"light 1 of ", "needs the key \"position\""});
    expect_refused(R"({"lights": [{"kind": "point", "position": [0, 0, 1], "range": -1}]})",
                   {"\"range\" in light 1 of ", "must be greater than 0"});
    expect_refused(R"({"lights": [{"kind": "sun", "direction": "down"}]})",
                   {"\"direction\"", "must be 3 numbers in []"});
    expect_refused(R"({"lights": [{"kind": "sun", "direction": [0, 0, {}]}]})", {"\"direction\"", "a number"});
    expect_refused(R"({"lights": [{"kind": "sun", "direction": [0, 0, -1], "energy": 5}]})",
                   {"unknown key \"energy\""});
    expect_refused(R"({"lamps": []})",
                   {"\"lights\" in [lighting] cannot be used", "not a file of lights: expected {\"lights\""});
    expect_refused(R"({"lights": [3]})", {"not a file of lights"});
    expect_refused("[]", {"not a file of lights"});
    expect_refused("{\"lights\": [}", {"not a file of lights: the JSON is malformed at line 1"});
    expect_refused("", {"not a file of lights"});
}

}  // namespace
}  // namespace wrinkle
