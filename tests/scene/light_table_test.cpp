// Tables of lights in all forms: reading them, and the messages about mistakes.
#include <limits>

#include "tests/scene/records.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

class LightTable : public SceneFolder {
protected:
    void expect_refused(const std::string& name, const std::string& bytes,
                        const std::vector<std::string>& parts) const {
        std::string message = "nothing was refused";
        try {
            load_lights(write(name, bytes));
        } catch (const Error& error) { message = error.what(); }
        for (const std::string& part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << part << "\n" << message;
    }
};

void expect_two_lights(const std::vector<Light>& lights) {
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].kind, LightKind::point);
    EXPECT_EQ(lights[0].position, (Vec3{1, 2.5, -3}));
    EXPECT_EQ(lights[0].color, (Vec3{1, 0.5, 0.25}));
    EXPECT_EQ(lights[0].intensity, 40);
    EXPECT_EQ(lights[0].range, 8);
    EXPECT_EQ(lights[1].kind, LightKind::spot);
    EXPECT_EQ(lights[1].color, (Vec3{1, 1, 1}));
    EXPECT_EQ(lights[1].intensity, 1);
    EXPECT_FALSE(lights[1].range);
    EXPECT_EQ(lights[1].direction, (Vec3{0, 1, 0}));
    EXPECT_NEAR(lights[1].inner_angle, 10 * degree, 1e-15);
    EXPECT_NEAR(lights[1].outer_angle, 30 * degree, 1e-15);
}

TEST_F(LightTable, HoldsWhatItSays) {
    expect_two_lights(load_lights(
        write("lamps.csv",
              "x,y,z,kind,r,g,b,intensity,range,direction_x,direction_y,direction_z,inner_angle,outer_angle\n"
              "1,2.5,-3,,1,0.5,0.25,40,8,,,,,\n"
              "4,5,6,spot,,,,,,0,1,0,10,30\n")));
    expect_two_lights(load_lights(write("lamps.toml",
                                        "[[light]]\nposition = [1, 2.5, -3]\ncolor = [1, 0.5, 0.25]\nintensity = 40\n"
                                        "range = 8\n[[light]]\nkind = \"spot\"\nposition = [4, 5, 6]\n"
                                        "direction = [0, 1, 0]\ninner_angle = 10\nouter_angle = 30\n")));
    Records records("('x', '<f8'), ('y', '<f8'), ('z', '<f8'), ('range', '<f4'), ('kind', '|S5')", 2);
    records.put(1.0).put(2.0).put(3.0).put(4.0f).text("point", 5);
    records.put(5.0).put(6.0).put(7.0).put(std::numeric_limits<float>::quiet_NaN()).text("spot", 5);
    const auto rows = load_lights(write("lamps.npy", records.bytes()));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].range, 4);
    EXPECT_FALSE(rows[1].range) << "NaN is none";
    EXPECT_EQ(rows[1].kind, LightKind::spot);
}

TEST_F(LightTable, NamesFileLineAndColumnOfAMistake) {
    const std::string head = "x,y,z,range,r,kind\n1,2,3,4,1,point\n";
    expect_refused("a.csv", "range,r\n1,1\n", {"a.csv:1: ", "the column \"x\" is missing", "\"y\"", "\"z\""});
    expect_refused("a.csv", head + "1,2,3,0,1,\n",
                   {"a.csv:3: column \"range\" is \"0\"; it must be a positive number"});
    expect_refused("a.csv", head + "1,2,3,-2,1,\n", {"a.csv:3: column \"range\" is \"-2\"", "a positive number"});
    expect_refused("a.csv", head + "1,2,3,nan,1,\n", {"a.csv:3: column \"range\" is \"nan\"", "a positive number"});
    expect_refused("a.csv", head + "nan,2,3,1,1,\n", {"a.csv:3: column \"x\" is \"nan\""});
    expect_refused("a.csv", head + "1,2,,1,1,\n", {"a.csv:3: column \"z\" is empty"});
    expect_refused("a.csv", head + "1,2,3,1,-1,\n",
                   {"a.csv:3: column \"r\" is \"-1\"; it must be 0 or a positive number"});
    expect_refused(
        "a.csv", head + "1,2,3,1,1,sun\n",
        {"column \"kind\" is \"sun\"", "\"point\", \"spot\", \"sphere\", \"disc\", \"rectangle\"", "[[light]]"});
    expect_refused("a.csv", "x,y,z,radios\n1,2,3,4\n", {"a.csv:1: unknown column \"radios\""});
    expect_refused("a.csv", "x,y,z,kind,radius\n1,2,3,disc,\n",
                   {"a.csv:2: ", "\"radius\" must be positive for a disc"});
    expect_refused("a.csv",
                   "x,y,z,kind,width,height,up_x,up_y,up_z\n1,2,3,rectangle,1,0,1,0,0\n1,2,3,rectangle,1,1,0,0,2\n",
                   {"a.csv:2: columns \"width\", \"height\" must be positive", "a.csv:3: ", "along the direction"});
    expect_refused("a.csv", "x,y,z,kind,inner_angle,outer_angle\n1,2,3,spot,30,30\n",
                   {"a.csv:2: columns \"inner_angle\", \"outer_angle\" must leave inner_angle"});
    expect_refused("a.csv", "", {"a.csv", "holds no table"});
    expect_refused("a.toml", "[[light]]\nrange = 1\n", {"a.toml:1: [[light]] 1: needs the key \"position\""});
    expect_refused("a.toml", "[[light]]\nposition = [0, 0, 0]\nrange = 0\n", {"a.toml:3: [[light]] 1: \"range\" is 0"});
    expect_refused("a.toml", "[[lamp]]\n", {"unknown key \"lamp\"; a table of lights holds [[light]] only"});
    Records nan("('x', '<f8'), ('y', '<f8'), ('z', '<f8')", 1);
    nan.put(1.0).put(std::numeric_limits<double>::quiet_NaN()).put(3.0);
    expect_refused("a.npy", nan.bytes(), {"a.npy: row 0: column \"y\" is nan"});
}

TEST_F(LightTable, BelongsToTheLighting) {
    write("lamps.csv", "x,y,z,range\n1,2,3,4\n");
    const Scene scene = load_with("[lighting]\nrelight = \"lit\"\nlights = \"lamps.csv\"\n");
    ASSERT_TRUE(scene.lighting.table);
    EXPECT_EQ(scene.lighting.table->size(), 1u);
    EXPECT_EQ(scene.lighting.table_file, folder_ / "lamps.csv");
    check(scene);
    expect_problem_with("[lighting]\nlights = \"lamps.csv\"\n", 6, {"\"lights\"", "no effect while relighting is off"});
    expect_problem_with("[lighting]\nrelight = \"lit\"\nlights = \"no.csv\"\n", 7, {"\"lights\"", "no.csv"});
    write("lamps.csv", "x,y,z\n1,2,3,4\n");
    const auto found = problems(frame_ + "[lighting]\nrelight = \"lit\"\nlights = \"lamps.csv\"\n");
    ASSERT_FALSE(found.empty());
    EXPECT_NE(found[0].find("\"lights\" in [lighting] cannot be used"), std::string::npos) << found[0];
    write("none.csv", "x,y,z\n");
    expect_problem_with("[lighting]\nrelight = \"lit\"\nlights = \"none.csv\"\n", 6, {"relight without light"});
}

TEST_F(LightTable, OfCodeIsCheckedLikeOneOfAFile) {
    const auto expect_refused = [&](Light light, const std::vector<std::string>& parts) {
        Scene scene = load_with("");
        scene.lighting.relight = Relight::lit;
        scene.lighting.table = std::make_shared<const std::vector<Light>>(1, std::move(light));
        try {
            check(scene);
            ADD_FAILURE() << "nothing was refused";
        } catch (const Error& error) {
            for (const std::string& part : parts)
                EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << part << "\n" << error.what();
        }
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_refused({.kind = LightKind::sun}, {"row 0: \"kind\" must be one of"});
    expect_refused({.kind = LightKind::disc}, {"row 0: ", "\"radius\" must be positive"});
    expect_refused({.kind = LightKind::point, .range = -1}, {"row 0: \"range\" must be a positive number"});
    expect_refused({.kind = LightKind::point, .range = nan}, {"row 0: \"range\""});
    expect_refused({.kind = LightKind::point, .position = {0, nan, 0}}, {"row 0: element 2 of \"position\""});
    expect_refused({.kind = LightKind::spot, .direction = {}}, {"row 0: \"direction\" must not be zero"});
    expect_refused({.kind = LightKind::point, .picture = "sun"}, {"row 0: ", "picture"});
}

TEST_F(LightTable, HoldsLightsWithAnExtent) {
    const auto expect = [](const std::vector<Light>& lights) {
        ASSERT_EQ(lights.size(), 3u);
        EXPECT_EQ(lights[0].kind, LightKind::sphere);
        EXPECT_EQ(lights[0].radius, 0.5);
        EXPECT_EQ(lights[1].kind, LightKind::disc);
        EXPECT_EQ(lights[1].direction, (Vec3{1, 0, 0}));
        EXPECT_EQ(lights[2].kind, LightKind::rectangle);
        EXPECT_EQ(lights[2].size, (std::array<double, 2>{2, 3}));
        EXPECT_EQ(lights[2].up, (Vec3{0, 1, 0}));
    };
    expect(load_lights(
        write("lamps.csv",
              "x,y,z,kind,radius,direction_x,direction_y,direction_z,width,height,up_x,up_y,up_z\n"
              "1,2,3,sphere,0.5,,,,,,,,\n1,2,3,disc,0.25,1,0,0,,,,,\n1,2,3,rectangle,,0,0,-1,2,3,0,1,0\n")));
    expect(
        load_lights(write("lamps.toml",
                          "[[light]]\nkind = \"sphere\"\nposition = [1, 2, 3]\nradius = 0.5\n"
                          "[[light]]\nkind = \"disc\"\nposition = [1, 2, 3]\nradius = 0.25\ndirection = [1, 0, 0]\n"
                          "[[light]]\nkind = \"rectangle\"\nposition = [1, 2, 3]\nsize = [2, 3]\nup = [0, 1, 0]\n")));
}

TEST_F(LightTable, LightsByThemselvesHaveExtentsToo) {
    const std::string lit = "[lighting]\nrelight = \"lit\"\n[[light]]\nposition = [0, 0, 1]\n";
    const std::string flat = lit + "direction = [0, 0, -1]\nkind = ";
    const Light light = load_with(flat + "\"rectangle\"\nsize = [2, 3]\nup = [0, 1, 0.5]\n").lighting.lights[0];
    EXPECT_EQ(light.size, (std::array<double, 2>{2, 3}));
    check(load_with(flat + "\"disc\"\nradius = 2\n"));
    check(load_with(lit + "kind = \"sphere\"\nradius = 0\n"));
    const std::string sun = "[lighting]\nrelight = \"lit\"\n[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\n";
    EXPECT_NEAR(load_with(sun + "angle = 0.5\n").lighting.lights[0].angle, 0.5 * degree, 1e-15);
    expect_problem_with(sun + "angle = 175\n", 10, {"\"angle\" in [[light]] 1 must be at least 0 and at most 170"});
    expect_problem_with(flat + "\"disc\"\nradius = 0\n", 11, {"\"radius\" in [[light]] 1 must be positive for a disc"});
    expect_problem_with(flat + "\"disc\"\n", 7, {"[[light]] 1 needs the key \"radius\""});
    expect_problem_with(flat + "\"rectangle\"\nsize = [2, 3]\nup = [0, 0, 2]\n", 12,
                        {"\"up\" in [[light]] 1 must not be zero or along the direction"});
    expect_problem_with(flat + "\"rectangle\"\nsize = [2, 0]\nup = [0, 1, 0]\n", 11, {"\"size\"", "must be positive"});
}

TEST_F(LightTable, LightsByThemselvesHaveRangesToo) {
    const std::string point = "[lighting]\nrelight = \"lit\"\n[[light]]\nkind = \"point\"\nposition = [0, 0, 1]\n";
    EXPECT_EQ(load_with(point + "range = 3\n").lighting.lights[0].range, 3);
    EXPECT_FALSE(load_with(point).lighting.lights[0].range);
    expect_problem_with(point + "range = 0\n", 10, {"\"range\" in [[light]] 1 must be greater than 0"});
    expect_problem_with(point + "range = -1.5\n", 10, {"\"range\" in [[light]] 1 must be greater than 0"});
    expect_problem_with(point + "range = nan\n", 10, {"\"range\" in [[light]] 1 must be a finite number"});
    expect_problem_with(
        "[lighting]\nrelight = \"lit\"\n[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\nrange = 2\n", 10,
        {"\"range\"",
         "does not belong to kind \"sun\" but to \"point\", \"spot\", \"sphere\", \"disc\", \"rectangle\""});
}

}  // namespace
}  // namespace wrinkle
