// Tables of decals in TOML: reading them, and the messages about mistakes.
#include <algorithm>
#include <cmath>
#include <random>

#include "tests/scene/decal_forms.h"

namespace wrinkle {
namespace {

class DecalToml : public DecalFolder {
protected:
    std::vector<Projector> read(const std::string& text) const { return DecalFolder::read("decals.toml", text); }
    void expect_refused(const std::string& text, const std::vector<std::string>& parts) const {
        DecalFolder::expect_refused("decals.toml", text, parts);
    }
    /// Expects that `keys`, written behind the centre of the second decal, are refused, once and with their line.
    void expect_key_refused(const std::string& keys, const std::vector<std::string>& parts) const {
        const std::string text = before_ + keys + after_;
        const std::string message = refusal("decals.toml", text);
        EXPECT_EQ(message.rfind((folder_ / "decals.toml").string() + ":", 0), 0u) << message;
        EXPECT_EQ(std::ranges::count(message, '\n'), 0) << message;
        EXPECT_NE(message.find(": [[decal]] 2: "), std::string::npos) << message;
        expect_refused(text, parts);
    }

    const std::string before_ = "[[decal]]\ncenter = [4, 5, 6]\n\n[[decal]]\ncenter = [1, 2, 3]\n";
    const std::string after_ = "\n[[decal]]\ncenter = [7, 8, 9]\n";
};

TEST_F(DecalToml, HoldsWhatItSays) {
    const auto rows = read(
        "# scratches\n"
        "[[decal]]\n"
        "center = [1, 2.5, -3e-1]\nshape = \"cone\"\ntexture = 1\nhalf_size = [0.25, 0.5, 0.5]\n"
        "mode = \"replace\"\npriority = -7\nwrap = \"tile\"\nobject = 3\nangle_fade = [10, 60]\ntwo_sided = true\n"
        "[[decal]]\n"
        "center = [+4, 5.0, 6]\nshape = \"\"\ncryptomatte = \"Rock\"\ntwo_sided = false\n");
    expect_two_decals(rows);
    EXPECT_EQ(rows.at(0).line, 2u);
    EXPECT_EQ(rows.at(1).line, 13u);
    expect_two_decals(
        read("decal = [\n  { center = [1, 2.5, -0.3], shape = \"cone\", texture = 1, half_size = [0.25, 0.5, 0.5], "
             "mode = \"replace\", priority = -7, wrap = \"tile\", object = 3, angle_fade = [10, 60], two_sided = "
             "\"yes\" },\n  { center = [4, 5, 6], cryptomatte = \"Rock\" },\n]\n"));
}

TEST_F(DecalToml, TakesOneNumberForEveryElement) {
    const auto rows = read("[[decal]]\ncenter = [0, 0, 0]\nhalf_size = 2\nfalloff = 0.25\nrepeat = 3\n");
    ASSERT_EQ(rows.size(), 1u);
    EXPECT_EQ(rows[0].half_size, (Vec3{2, 2, 2}));
    EXPECT_EQ(rows[0].falloff, (Vec3{0.25, 0.25, 0.25}));
    EXPECT_EQ(rows[0].repeat, (std::array<double, 2>{3, 3}));
    expect_key_refused("axis_x = 1\n", {"decals.toml:6: [[decal]] 2: \"axis_x\" is 1; it must be 3 numbers in []"});
    expect_key_refused("region = 1\n", {"\"region\" is 1; it must be 4 numbers in []"});
}

TEST_F(DecalToml, NamesFileLineDecalAndKeyOfAMistake) {
    for (const DecalMistake& mistake : decal_mistakes()) {
        expect_key_refused(mistake.toml, mistake.parts);
        expect_key_refused(mistake.toml, mistake.toml_parts);
    }
    expect_key_refused("scale = 1\nhalf_size = [1, 0, 1]\n", {"decals.toml:7: ", "element 2"});
    expect_key_refused("region = [1, 0, 0, 1]\n", {"decals.toml:4: "});
}

TEST_F(DecalToml, SaysWhatTypeAKeyTakes) {
    expect_key_refused("half_size = [\"1\", 1, 1]\n", {"the text \"1\"", "must be a number"});
    expect_key_refused("half_size = [1, 1]\n", {": \"half_size\" is 2 values in []", "must be 3 numbers in []"});
    expect_key_refused("scale = true\n", {"\"scale\" is true", "must be a number"});
    expect_key_refused("scale = \"0.5\"\n", {"the text \"0.5\"", "must be a number"});
    expect_key_refused("object = nan\n", {"\"object\" is nan", "must be a number"});
    expect_key_refused("shape = 1\n", {"\"shape\" is 1", "must be a text"});
    expect_key_refused("cryptomatte = true\n", {"\"cryptomatte\" is true", "must be a text"});
    expect_key_refused("two_sided = 1\n", {"\"two_sided\" is 1", "must be true or false"});
    expect_key_refused("scale = 1979-05-27\n", {"a date or time"});
}

TEST_F(DecalToml, TakesNumbersOfAnySize) {
    const auto rows = read("[[decal]]\ncenter = [1e-300, -0.0, +1_000.5]\nscale = 2.2250738585072014e-308\n");
    EXPECT_EQ(rows.at(0).center, (Vec3{1e-300, 0, 1000.5}));
    EXPECT_EQ(rows.at(0).scale, 2.2250738585072014e-308);
    for (const char* number : {"1e400", "1e-400"})
        expect_refused(before_ + "scale = " + number + "\n", {"decals.toml:6", number, "not representable"});
}

TEST_F(DecalToml, KnowsTheKeys) {
    expect_key_refused("shap = \"box\"\n", {"decals.toml:6: ", "unknown key \"shap\"; did you mean \"shape\"?"});
    expect_key_refused("half_y = 1\n", {"\"half_y\" is written half_size = [half_x, half_y, half_z]"});
    expect_key_refused("s1 = 1\n", {"\"s1\" is written region = [s0, t0, s1, t1]"});
    expect_refused("[[decal]]\nscale = 1\n", {"decals.toml:1: [[decal]] 1: needs the key \"center\""});
    expect_refused("[[decal]]\ncenter = [0, 0, 0]\n[camera]\n", {"decals.toml:3: unknown key \"camera\""});
    expect_refused("[decal]\ncenter = [0, 0, 0]\n", {"decals.toml:1: \"decal\" must be an array of tables: [[decal]]"});
    expect_refused("decal = [1]\n", {"decals.toml:1: \"decal\" must be an array of tables"});
    expect_refused("", {"decals.toml: holds no [[decal]]"});
    expect_refused("[[decal]]\ncenter = [0, 0\n", {"decals.toml:", "not valid TOML"});
    expect_refused("x,y,z\n1,2,3\n", {"decals.toml:1:", "not valid TOML"});
    EXPECT_TRUE(read("decal = []\n").empty());
}

TEST_F(DecalToml, ReportsManyMistakesButNotAll) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "[[decal]]\ncenter = [0, 0]\n";
    const std::string message = refusal("decals.toml", text);
    EXPECT_EQ(std::ranges::count(message, '\n'), 20);
    EXPECT_NE(message.find("decals.toml:2000: [[decal]] 1000: and 980 more mistakes"), std::string::npos) << message;
}

/// A large table is parsed in pieces, which must not show in anything.
TEST_F(DecalToml, CountsDecalsAndLinesOfLargeTables) {
    constexpr int count = 20000;
    std::string text = "# large\n";
    for (int i = 0; i < count; ++i) text += "[[decal]]\r\ncenter = [" + std::to_string(i) + ", 0, 0]\r\n# x\n\n";
    for (const char* first : {"", "# '''\n"}) {  // the second is parsed in one piece, as its quotes might span lines
        const auto rows = read(first + text);
        ASSERT_EQ(rows.size(), static_cast<std::size_t>(count));
        const std::uint32_t skipped = *first == '\0' ? 1 : 2;
        for (int i = 0; i < count; ++i) {
            ASSERT_EQ(rows[static_cast<std::size_t>(i)].center[0], i);
            ASSERT_EQ(rows[static_cast<std::size_t>(i)].line, skipped + 1 + 4 * static_cast<std::uint32_t>(i));
        }
    }
    EXPECT_EQ(read(std::string(600'000, '#') + "\n" + text).size(), static_cast<std::size_t>(count));
    std::string mistaken = text;  // with a mistake in each of two pieces; lines keep their lengths
    for (const int decal : {7000, 14000}) {
        const std::string good = "[" + std::to_string(decal) + ", 0, 0]";
        mistaken.replace(mistaken.find(good), good.size(), "[" + std::string(good.size() - 2, '1') + "]");
    }
    expect_refused(mistaken, {"decals.toml:28003: [[decal]] 7001: \"center\" is 1 values in []",
                              "decals.toml:56003: [[decal]] 14001: \"center\" is 1 values in []"});
    expect_refused(mistaken + "[[decal]]\ncenter = [\n", {"decals.toml:8000", "not valid TOML"});
    expect_refused(text + "[[decal]]\nscale = 2\n", {"decals.toml:80002: [[decal]] 20001: needs the key \"center\""});
    expect_refused(text + "[[decal]]\ncenter = [\n", {"decals.toml:8000", "not valid TOML"});
}

TEST_F(DecalToml, DamagedAnywhereItParsesOrThrowsError) {
    const std::string text = before_ + "shape = \"cone\"\ntwo_sided = true\nregion = [0, 0, 0.5, 1]\n" + after_;
    const std::string bytes = "[]{}=\"'#.,-+ \n\r\t0159aez_\\\x01\x7f\xc3\xff";
    std::mt19937 random(3);
    int refused = 0;
    for (int i = 0; i < 1000; ++i) {
        std::string damaged = text;
        for (int hits = 0; hits <= i % 3; ++hits) damaged[random() % damaged.size()] = bytes[random() % bytes.size()];
        try {
            for (const Projector& row : read(damaged)) ASSERT_TRUE(std::isfinite(row.center[0])) << damaged;
        } catch (const Error& error) {
            ++refused;
            EXPECT_NE(std::string(error.what()).find("decals.toml"), std::string::npos) << damaged;
        }
    }
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace wrinkle
