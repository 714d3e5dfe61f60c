// Tables of decals in CSV: reading them, and the messages about mistakes.
#include <algorithm>

#include "tests/scene/decal_forms.h"
#include "wrinkle/limits.h"

namespace wrinkle {
namespace {

class DecalTable : public DecalFolder {
protected:
    void expect_refused(const std::string& text, const std::vector<std::string>& parts) const {
        DecalFolder::expect_refused("decals.csv", text, parts);
    }
};

TEST_F(DecalTable, HoldsWhatItSays) {
    expect_two_decals(
        read("decals.csv",
             "# scratches, 5\" long\n"
             "x, y ,z,shape,texture,half_x,mode,priority,wrap,object,cryptomatte,angle_full,angle_zero,two_sided\r\n"
             "1,2.5,-3e-1,cone,1,0.25,replace,-7,tile,3,,10,60,yes\n"
             "\n"
             "+4,5,6,,,,,,,,Rock,,,\n"));
}

TEST_F(DecalTable, IsWhatSpreadsheetsWrite) {
    const std::string mark = "\xef\xbb\xbf";
    for (const std::string& text :
         {mark + "x,y,z,cryptomatte\r\n1,2,3,Rock\r\n", mark + "# from a sheet\nx,y,z,cryptomatte\n1,2,3,Rock",
          std::string("\"x\",\"y\",\"z\",\"cryptomatte\"\n\"1\",\"2\",\"3\",\"Rock\"\n"),
          std::string("x,y,z,cryptomatte\r# a comment\r1,2,3,Rock\r")}) {
        const auto rows = read("decals.csv", text);
        ASSERT_EQ(rows.size(), 1u) << text;
        EXPECT_EQ(rows[0].center, (Vec3{1, 2, 3})) << text;
        EXPECT_EQ(rows[0].cryptomatte, "Rock") << text;
    }
    const auto rows = read("decals.csv", "x,y,z,cryptomatte\n1,2,3,\"rock, \"\"wet\"\"\n# and old\"\n4,5,6,\n");
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].cryptomatte, "rock, \"wet\"\n# and old");
    EXPECT_EQ(rows[1].line, 4u);
    expect_refused("# of Excel\nx;y;z\n1,5;2;3\n", {"decals.csv:2: separated by ';'", "save with commas"});
    expect_refused(mark + "\"x\";\"y\";\"z\"\n", {"decals.csv:1: separated by ';'"});
    expect_refused("x\ty\tz\n1\t2\t3\n", {"decals.csv:1: separated by tabs", "save with commas"});
    expect_refused("x,y,z,cryptomatte\n1,2,3,\"Rock\n", {"decals.csv:2: a quote is not closed"});
    expect_refused("x,y,z,cryptomatte\n1,2,3,5\" nail\n", {"decals.csv:2: a quote within a cell"});
}

TEST_F(DecalTable, NamesFileLineAndColumnOfAMistake) {
    for (const DecalMistake& mistake : decal_mistakes()) {
        const std::string commas(static_cast<std::size_t>(std::ranges::count(std::string(mistake.columns), ',')), ',');
        const std::string text = std::string("x,y,z,") + mistake.columns + "\n4,5,6," + commas + "\n1,2,3," +
                                 mistake.fields + "\n7,8,9," + commas + "\n";
        const std::string message = refusal("decals.csv", text);
        EXPECT_EQ(message.rfind((folder_ / "decals.csv").string() + ":3: ", 0), 0u) << message;
        EXPECT_EQ(std::ranges::count(message, '\n'), 0) << message;
        expect_refused(text, mistake.parts);
        expect_refused(text, mistake.csv_parts);
    }
    const std::string head = "x,y,z,half_x,texture,shape,s0,s1\n";
    expect_refused(head + "1,2,3,1,0,box,,\n1,abc,3,1,0,box,,\n", {"decals.csv:3: ", "\"y\"", "\"abc\""});
    expect_refused(head + "1,2,3,1\n", {"decals.csv:2: ", "4 fields", "8 columns"});
    expect_refused(head + "1,,3,1,0,box,,\n", {"decals.csv:2: ", "\"y\" is empty"});
    expect_refused(head + "1,nan,3,1,0,box,,\n1,1e300,3,1,0,box,,\n", {"decals.csv:2: ", "decals.csv:3: "});
    expect_refused("x,y,half\n1,2,3\n", {"decals.csv:1: ", "unknown column \"half\"", "half_x", "\"z\" is missing"});
    expect_refused("x,y,z,x\n", {"\"x\" is there twice"});
    expect_refused("", {"decals.csv", "names the columns"});
}

TEST_F(DecalTable, ReportsManyMistakesButNotAll) {
    std::string text = "x,y,z\n";
    for (int i = 0; i < 1000; ++i) text += "a,2,3\n";
    const std::string message = refusal("decals.csv", text);
    EXPECT_EQ(std::ranges::count(message, '\n'), 20);
    EXPECT_NE(message.find("decals.csv:1001: and 980 more mistakes"), std::string::npos) << message;
}

TEST_F(DecalTable, TakesFarMoreMemoryThanItsFileOnlyWhenAllowed) {
    std::string text = "x,y,z\n";
    for (int i = 0; i < 3'000'000; ++i) text += "1,2,3\n";
    expect_refused(text, {"decals.csv: a table of 3000001 decals in a file of 18.0 MB would take 3.9 GB of memory",
                          "allow that by --memory or WRINKLE_MEMORY"});
    set_limits({.memory = std::uint64_t{2} << 30, .sandbox = {}, .volume_reader = {}});
    expect_refused(text,
                   {"decals.csv: a table of 3000001 decals would take 3.9 GB", "the limit of --memory is 2.1 GB"});
    text = "\n";
    for (int i = 0; i < 200'000; ++i) text += "[[decal]]\ncenter=[1,2,3]\n";
    set_limits({.memory = 1, .sandbox = {}, .volume_reader = {}});
    DecalFolder::expect_refused("decals.toml", text, {"decals.toml: a table of 200000 decals would take 260 MB"});
    set_limits({});
    text = "x,y,z\r";
    for (int i = 0; i < 3'000'000; ++i) text += "1,2,3\r";
    expect_refused(text, {"decals.csv: a table of 3000001 decals in a file of 18.0 MB"});
    EXPECT_EQ(read("decals.csv", "x,y,z\n" + std::string(3'000'000, '\n') + "1,2,3\n").size(), 1u) << "empty lines";
}

TEST_F(DecalTable, ReadsBackWhatWasSaved) {
    Projector p;
    p.center = {0.1, 1.0 / 3, -7e-9};
    p.texture = 1;
    p.shape = ProjectorShape::sphere;
    p.region = {0.25, 0, 1, 0.5};
    p.opacity = 0.7;
    p.object = 5;
    p.two_sided = true;
    Projector named;
    named.cryptomatte = "rock, \"wet\" \\ old";
    const std::vector<Projector> rows{p, Projector{}, named};
    for (const char* name : {"saved.csv", "saved.toml", "SAVED.TOML"}) {
        save_decals(folder_ / name, rows);
        const auto back = load_decals(folder_ / name, 2);
        ASSERT_EQ(back.size(), 3u) << name;
        EXPECT_EQ(back[0].center, p.center) << name;
        EXPECT_EQ(back[0].texture, 1u) << name;
        EXPECT_EQ(back[0].shape, p.shape) << name;
        EXPECT_EQ(back[0].region, p.region) << name;
        EXPECT_EQ(back[0].opacity, 0.7) << name;
        EXPECT_EQ(back[0].object, 5) << name;
        EXPECT_TRUE(back[0].two_sided) << name;
        EXPECT_EQ(back[1].half_size, Projector{}.half_size) << name;
        EXPECT_FALSE(back[1].object) << name;
        EXPECT_FALSE(back[1].two_sided) << name;
        EXPECT_EQ(back[2].cryptomatte, named.cryptomatte) << name;
        save_decals(folder_ / name, {});
        EXPECT_TRUE(load_decals(folder_ / name, 2).empty()) << name;
    }
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
    EXPECT_EQ(layer.rows->at(0).line, 2u);
    EXPECT_EQ(layer.file, folder_ / "decals.csv");

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
