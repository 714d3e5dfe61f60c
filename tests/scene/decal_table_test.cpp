// Tables of decals: what they hold, and what is said of mistakes in them.
#include <algorithm>

#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

class DecalTable : public SceneFolder {
protected:
    std::vector<Projector> read(const std::string& text, std::size_t textures = 2) const {
        return load_decals(write("decals.csv", text), textures);
    }
    std::string refusal(const std::string& text) const {
        try {
            read(text);
        } catch (const Error& error) { return error.what(); }
        return "nothing was refused";
    }
    void expect_refused(const std::string& text, const std::vector<std::string>& parts) const {
        const std::string message = refusal(text);
        for (const std::string& part : parts)
            EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
    }
};

TEST_F(DecalTable, HoldsWhatItSays) {
    const auto rows = read(
        "# scratches\n"
        "x, y ,z,shape,texture,half_x,mode,priority,wrap,object,cryptomatte,angle_full,angle_zero,two_sided\r\n"
        "1,2.5,-3e-1,cone,1,0.25,replace,7,tile,3,,10,60,yes\n"
        "\n"
        "+4,5,6,,,,,,,,Rock,,,\n");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].center, (Vec3{1, 2.5, -0.3}));
    EXPECT_EQ(rows[0].shape, ProjectorShape::cone);
    EXPECT_EQ(rows[0].texture, 1u);
    EXPECT_EQ(rows[0].half_size, (Vec3{0.25, 0.5, 0.5}));
    EXPECT_EQ(rows[0].mode, ProjectorMode::replace);
    EXPECT_EQ(rows[0].priority, 7);
    EXPECT_EQ(rows[0].wrap, Wrap::repeat);
    EXPECT_EQ(rows[0].object, 3);
    EXPECT_NEAR(rows[0].angle_fade[0], 0.5, 1e-15);
    EXPECT_TRUE(rows[0].two_sided);
    EXPECT_EQ(rows[1].center, (Vec3{4, 5, 6}));
    EXPECT_EQ(rows[1].shape, ProjectorShape::box);
    EXPECT_EQ(rows[1].cryptomatte, "Rock");
    EXPECT_FALSE(rows[1].object);
}

TEST_F(DecalTable, NamesLineAndColumnOfAMistake) {
    const std::string head = "x,y,z,half_x,texture,shape,s0,s1\n";
    expect_refused(head + "1,2,3,0,0,box,,\n", {"decals.csv:2: ", "\"half_x\"", "\"0\"", "a positive number"});
    expect_refused(head + "1,2,3,1,0,box,,\n1,abc,3,1,0,box,,\n", {"decals.csv:3: ", "\"y\"", "\"abc\""});
    expect_refused(head + "1,2,3,1,2,box,,\n", {"decals.csv:2: ", "\"texture\" is 2", "2 textures, counted from 0"});
    expect_refused(head + "1,2,3,1,0,ball,,\n", {"\"shape\"", "\"ball\"", "\"box\", \"sphere\", \"cone\""});
    expect_refused(head + "1,2,3,1,0,box,0.5,0.5\n", {"decals.csv:2: ", "\"s0\"", "\"s1\""});
    expect_refused(head + "1,2,3,1\n", {"decals.csv:2: ", "4 fields", "8 columns"});
    expect_refused(head + "1,,3,1,0,box,,\n", {"decals.csv:2: ", "\"y\" is empty"});
    expect_refused(head + "1,nan,3,1,0,box,,\n1,1e300,3,1,0,box,,\n", {"decals.csv:2: ", "decals.csv:3: "});
    expect_refused("x,y,z,object,cryptomatte\n0,0,0,1,Rock\n", {"decals.csv:2: ", "cannot both be given"});
    expect_refused("x,y,half\n1,2,3\n", {"decals.csv:1: ", "unknown column \"half\"", "half_x", "\"z\" is missing"});
    expect_refused("x,y,z,x\n", {"\"x\" is there twice"});
    expect_refused("", {"decals.csv", "names the columns"});
    expect_refused("x,y,z,axis_x_x,axis_x_z\n0,0,0,0,0\n", {"must not be parallel, nor zero"});
}

TEST_F(DecalTable, ReportsManyMistakesButNotAll) {
    std::string text = "x,y,z\n";
    for (int i = 0; i < 1000; ++i) text += "a,2,3\n";
    const std::string message = refusal(text);
    EXPECT_EQ(std::ranges::count(message, '\n'), 20);
    EXPECT_NE(message.find("decals.csv:1001: and 980 more mistakes"), std::string::npos) << message;
}

TEST_F(DecalTable, ReadsBackWhatWasSaved) {
    Projector p;
    p.center = {0.1, 1.0 / 3, -7e-9};
    p.texture = 1;
    p.shape = ProjectorShape::sphere;
    p.opacity = 0.7;
    p.object = 5;
    const std::vector<Projector> rows{p, Projector{}};
    save_decals(folder_ / "saved.csv", rows);
    const auto back = load_decals(folder_ / "saved.csv", 2);
    ASSERT_EQ(back.size(), 2u);
    EXPECT_EQ(back[0].center, p.center);
    EXPECT_EQ(back[0].texture, 1u);
    EXPECT_EQ(back[0].shape, p.shape);
    EXPECT_EQ(back[0].opacity, 0.7);
    EXPECT_EQ(back[0].object, 5);
    EXPECT_EQ(back[1].half_size, Projector{}.half_size);
    EXPECT_FALSE(back[1].object);
}

TEST_F(DecalTable, BelongsToALayer) {
    write("decals.csv", "x,y,z\n1,2,3\n");
    const Scene scene = load_with(
        "[[layer]]\nkind = \"decals\"\nfile = \"decals.csv\"\n"
        "textures = [{ file = \"textures/wall.png\" }, { file = \"textures/wall.png\", content = \"normal\", y = \"-\" "
        "}]\n");
    const auto& layer = std::get<DecalsLayer>(scene.layers.at(0).bump);
    ASSERT_EQ(layer.textures.size(), 2u);
    EXPECT_EQ(layer.textures[1].content, Content::normal);
    EXPECT_TRUE(layer.textures[1].y_down);
    EXPECT_EQ(layer.rows->size(), 1u);

    write("bad.csv", "x,y,z\n1,2,q\n");
    expect_problem_with("[[layer]]\nkind = \"decals\"\nfile = \"decals.csv\"\ntextures = []\n", 8,
                        {"\"textures\"", "at least one"});
    const auto found = problems(frame_ +
                                "[[layer]]\nkind = \"decals\"\nfile = \"bad.csv\"\n"
                                "textures = [{ file = \"textures/wall.png\" }]\n");
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NE(found[0].find("courtyard.toml:7: \"file\""), std::string::npos) << found[0];
    EXPECT_NE(found[1].find("bad.csv:2: column \"z\""), std::string::npos) << found[1];
}

}  // namespace
}  // namespace wrinkle
