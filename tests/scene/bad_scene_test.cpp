#include "tests/scene/layer_texts.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using BadScene = SceneFolder;

TEST_F(BadScene, FileThatCannotBeRead) {
    const auto message = [](const std::filesystem::path& file) -> std::string {
        try {
            load_scene(file);
        } catch (const Error& error) { return error.what(); }
        return "";
    };
    const std::string missing = (folder_ / "missing.toml").string();
    EXPECT_EQ(message(missing), missing + ": there is no such file");
    EXPECT_NE(message(folder_).find("is a folder; a scene file was expected"), std::string::npos);
    for (const char* text : {"", "# nothing but a comment\n"})
        EXPECT_EQ(message(write("courtyard.toml", text)),
                  (folder_ / "courtyard.toml").string() + ": the scene is empty; it needs [gbuffer]");
    EXPECT_NE(message(write("courtyard.toml", std::string("v/1\1\2\0\0\0", 8))).find("\"wrinkle info\""),
              std::string::npos);
}

TEST_F(BadScene, Syntax) {
    EXPECT_EQ(problems("[gbuffer]\nfile = \n").at(0).substr(0, 37), "courtyard.toml:2:8: not valid TOML: E");
    EXPECT_EQ(problems("a = 1\na = 2\n").at(0).substr(0, 35), "courtyard.toml:2:5: not valid TOML:");
    for (const char* text : {"[gbuffer\n", "[=]\n", "[.a]\n", "a = { [ = 1 }\n", "a.[ = 1\n"})
        EXPECT_EQ(problems(text).size(), 1u) << text;
    EXPECT_EQ(problems("name = \"\xff\"\n").size(), 1u);
    EXPECT_EQ(problems(std::string("a = \0 1", 7)).size(), 1u);
}

TEST_F(BadScene, Filters) {
    expect_problem_with("[filter]\ncurvature = 3\n", 6, {"curvature", "[filter]", "true or false"});
    expect_problem_with("[filter]\ncurvature = true\n", 6, {"no effect", "roughness", "slope_covariance"});
    expect_problem_with("[filter]\ncurvatures = true\n", 6, {"did you mean \"curvature\"?"});
}

TEST_F(BadScene, Budgets) {
    expect_problem_with("[budget]\nsample = 10\n", 5, {"[budget]", "max_error"});
    for (const char* value : {"0", "-0.1", "181", "inf", "nan", "\"small\""})
        expect_problem_with(std::string("[budget]\nmax_error = ") + value + "\n", 6, {"max_error", "[budget]"});
    for (const char* value : {"0", "181", "nan", "\"small\""})
        expect_problem_with(std::string("[budget]\nmax_area_error = ") + value + "\n", 6,
                            {"max_area_error", "[budget]"});
    expect_problem_with("[budget]\nmax_error = 1\nsample = 0\n", 7, {"sample"});
    expect_problem_with("[budget]\nmax_error = 1\nseed = -1\n", 7, {"seed"});
    expect_problem_with("[budget]\nmax_erorr = 1\nmax_error = 1\n", 6, {"did you mean \"max_error\"?"});
}

TEST_F(BadScene, UnknownKeys) {
    EXPECT_EQ(
        problems(frame_ + "[[layer]]\nname = \"cobbles\"\nkind = \"constant\"\ngradient = [0, 0, 1]\nscael = 2\n"),
        std::vector<std::string>{"courtyard.toml:9: unknown key \"scael\" in [[layer]] \"cobbles\"; did you mean "
                                 "\"scale\"? known keys: name, kind, gradient, project, scale, blend, "
                                 "footprint, mask"});
    expect_problem_with("[outptu]\n", 5, {"\"outptu\"", "did you mean \"output\"?", "gbuffer, camera, layer"});
    expect_problem_with("[[layers]]\nkind = \"noise\"\n", 5, {"\"layers\" in the scene", "did you mean \"layer\"?"});
    expect_problem_with("[output]\nPNG = true\n", 6, {"unknown key \"PNG\" in [output]", "did you mean \"png\"?"});
    expect_problem_with("[output]\nxyzzy = true\n", 6,
                        {"unknown key \"xyzzy\" in [output]; known keys: roughness, slope_cov"});
    expect_problem_with("[lighting]\nambiant = [1, 1, 1]\n", 6, {"[lighting]", "\"ambient\"?"});
    expect_problem_with(height_map("uv = { scal = 2 }\n"), 8, {"uv of [[layer]] \"height_map 1\"", "\"scale\"?"});
    expect_problem_with(noise("\n[layer.mask]\nobjekt = 2\nobject = 2\n"), 9,
                        {"mask of [[layer]] \"noise 1\"", "\"object\"?"});
    expect_problem_with("[gbuffer.roles]\npositoin = \"P\"\n", 6, {"roles of [gbuffer]", "\"position\"?"});
    expect_problem_with("[gbuffer.roles]\nposition.w = \"P.A\"\n", 6,
                        {"\"w\" in position of roles of [gbuffer]", "x, y, z"});
    expect_problem_with("\"a\\nb\" = 1\n", 5, {"unknown key \"a\\x0ab\""});
}

TEST_F(BadScene, UnknownNames) {
    expect_problem_with(layer("kind = \"decall\"\noctaves = 2\nscael = 2\n"), 6,
                        {"\"kind\" in [[layer]] 1 is \"decall\"; did you mean \"decal\"?", "allowed: \"normal_map\""});
    expect_problem_with(layer("octaves = 2\n"), 5, {"[[layer]] 1 needs the key \"kind\": \"normal_map\", "});
    expect_problem_with(layer("kind = 3\n"), 6, {"must be one of \"normal_map\"", "found 3"});
    expect_problem_with(parallax("mode = \"steep\"\n"), 8, {"\"mode\"", "allowed: \"offset\", \"march\""});
    expect_problem_with(parallax("mode = \"offset\"\nsteps = 9\n"), 9, {"\"steps\"", "mode", "march"});
    expect_problem_with(parallax("blend = \"add\"\n"), 8, {"\"blend\"", "does not belong to kind \"parallax\""});
    expect_problem_with(noise("blend = \"sub\"\n"), 7, {"is \"sub\"; allowed: \"add\", \"subtract\""});
    expect_problem_with(height_map("wrap = \"Clamp\"\n"), 8, {"did you mean \"clamp\"?"});
    expect_problem_with("[lighting]\nrelight = \"on\"\n[[light]]\nkind = \"sun\"\ndirection = [0, 0, 1]\n", 6,
                        {"\"off\", \"lit\", \"ratio\""});
}

TEST_F(BadScene, WrongTypes) {
    expect_problem_with(noise("scale = \"2\"\n"), 7,
                        {"\"scale\" in [[layer]] \"noise 1\" must be a number; found the text \"2\""});
    expect_problem_with(noise("octaves = 2.0\n"), 7, {"a whole number from 1 to 16; found 2.0"});
    expect_problem_with(noise("footprint = 1\n"), 7, {"must be true or false; found 1"});
    expect_problem_with(noise("name = 7\n"), 7, {"must be a text", "found 7"});
    expect_problem_with(noise("name = \"\"\n"), 7, {"not empty"});
    expect_problem_with(noise("name = \"a\\u0007b\"\n"), 7, {"without control characters"});
    expect_problem_with(noise("mask = 3\n"), 7, {"must be a table; found 3"});
    expect_problem_with(noise("scale = 2020-01-01\n"), 7, {"found a date or time"});
    expect_problem_with(decal("half_size = [1, 2]\n"), 9, {"must be 3 numbers in []; found 2 values in []"});
    expect_problem_with(decal("half_size = [1, 2, \"3\"]\n"), 9, {"each element a number", "\"3\""});
    expect_problem_with(height_map("uv = { scale = [1, 2, 3] }\n"), 8, {"must be 2 numbers"});
    expect_problem_with(height_map("uv = { scale = true }\n"), 8, {"must be a number; found true"});
    expect_problem_with("[[output]]\npng = true\n", 5, {"must be one table: [output], not [[output]]"});
    expect_problem_with("[layer]\nkind = \"noise\"\n", 5, {"must be an array of tables: [[layer]]; found a table"});
    expect_problem("layer = [1]\n" + frame_, 1, {"must be an array of tables: [[layer]]; found 1"});
    expect_problem("output = 3\n" + frame_, 1, {"\"output\" in the scene must be a table"});
}

TEST_F(BadScene, MissingKeys) {
    EXPECT_EQ(problems("[camera]\nfrom = \"exr\"\n"),
              std::vector<std::string>{"courtyard.toml: needs [gbuffer], at least file = \"frame.exr\""});
    expect_problem("[gbuffer]\n[camera]\nfrom = \"exr\"\n", 1, {"[gbuffer] needs the key \"file\""});
    for (const char* kind : {"normal_map", "height_map", "triplanar", "object_normal", "derivative_map"})
        expect_problem_with(layer("kind = \"" + std::string(kind) + "\"\n"), 5, {kind, "needs the key \"texture\""});
    expect_problem_with(layer("kind = \"decal\"\ntexture = \"textures/wall.png\"\n"), 5, {"needs the key \"center\""});
    expect_problem_with(layer("kind = \"constant\"\n"), 5, {"needs the key \"gradient\""});
}

TEST_F(BadScene, MissingFiles) {
    expect_problem_with(layer("kind = \"normal_map\"\ntexture = \"textures/wal.png\"\n"), 7,
                        {"\"texture\" in [[layer]] \"normal_map 1\" is \"textures/wal.png\": there is no file " +
                         (folder_ / "textures/wal.png").string()});
    expect_problem_with(layer("kind = \"normal_map\"\ntexture = \"textures\"\n"), 7, {"is a folder, not a file"});
    expect_problem_with(layer("kind = \"normal_map\"\ntexture = \"textures/%04d.png\"\n"), 7,
                        {"holds a place for a frame number, and none is given"});
    expect_problem_with(noise("mask = { texture = \"dirt.png\" }\n"), 7, {"mask of", "dirt.png"});
    expect_problem("[camera]\nfrom = \"exr\"\n[gbuffer]\nfile = \"none.exr\"\n", 4,
                   {"in [gbuffer]", "there is no file"});
    expect_problem("[camera]\nfrom = \"exr\"\n[gbuffer]\nfile = \"shots/f.####.exr\"\n", 4,
                   {"there is no folder", "shots"});
    expect_problem("[camera]\nfrom = \"exr\"\n[gbuffer]\nfile = \"shot.####/f.####.exr\"\n", 4,
                   {"there is no folder", "shot.####"});
    expect_problem("[gbuffer]\nfile = \"frame.exr\"\n[camera]\nfile = \"none.json\"\n", 4,
                   {"in [camera]", "none.json"});
}

TEST_F(BadScene, Camera) {
    const auto expect = [&](const std::string& text, int line, const std::vector<std::string>& parts) {
        expect_problem("[gbuffer]\nfile = \"frame.exr\"\n[camera]\n" + text, line, parts);
    };
    const std::string view = "view = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]\n";
    const std::string proj = "proj = [[1,0,0,0],[0,1,0,0],[0,0,-1,-0.2],[0,0,-1,0]]\n";
    expect("file = \"camera.json\"\n" + view + proj, 5, {"\"view\"", "again, beside \"file\" at line 4"});
    expect("eye = [0, 0, 0]\ntarget = [1, 0, 0]\nfov = 40\nfrom = \"exr\"\n", 4,
           {"\"eye\"", "beside \"from\" at line 7"});
    expect(view, 3, {"needs the key \"proj\""});
    expect(proj, 3, {"needs the key \"view\""});
    expect("eye = [0, 0, 0]\ntarget = [1, 0, 0]\n", 3, {"needs the key \"fov\""});
    expect("from = \"json\"\n", 4, {"allowed: \"exr\", \"positions\""});
    const std::string look = "eye = [0, 0, 0]\ntarget = [1, 0, 0]\n";
    expect(look + "fov_x = 40\nlens = 50\n", 7, {"\"lens\"", "states the field of view again, beside \"fov_x\""});
    expect(look + "fov = 40\nsensor = 36\n", 7, {"\"sensor\"", "only with the key \"lens\""});
    expect(look + "lens = 0\n", 6, {"\"lens\"", "greater than 0"});
    expect(look + "lens = 50\nfit = \"fill\"\n", 7, {"\"auto\", \"horizontal\", \"vertical\""});
    expect("eye = [0, 0, 0]\ntarget = [1, 0, 0]\nfov = 180\n", 6, {"greater than 0 and less than 180; found 180"});
    expect("eye = [0, 0, 0]\ntarget = [0, 0, 0]\nfov = 18\n", 5, {"same point"});
    expect("eye = [0, 0, 0]\ntarget = [0, 0, 2]\nfov = 18\n", 5,
           {"\"target\"", "parallel to up, which is [0, 0, 1] unless given", "set up = [0, 1, 0]"});
    expect("eye = [0, 0, 0]\ntarget = [0, 3, 0]\nup = [0, 1, 0]\nfov = 18\n", 6, {"\"up\"", "set up = [0, 0, 1]"});
    expect("eye = [0, 0, 0]\ntarget = [0, 0, 2]\nup = [0, 0, 0]\nfov = 18\n", 6, {"\"up\"", "zero"});
    expect("view = [[1,0,0],[0,1,0],[0,0,1]]\n" + proj, 4, {"\"view\"", "4x4"});
    expect("view = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,\"1\"]]\n" + proj, 4, {"a number"});
    expect("view = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[5,6,7,1]]\n" + proj, 4, {"transposed"});
    expect("view = [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]\n" + proj, 4, {"last row", "[0, 0, 0, 2]"});
    expect("view = [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]\n" + proj, 4, {"rigid"});
    expect(view + "proj = [[1,0,0,0],[1,0,0,0],[0,0,-1,-0.2],[0,0,-1,0]]\n", 5, {"singular"});
    expect(view + proj + "max_residual = 0\n", 6, {"greater than 0"});
}

TEST_F(BadScene, Lights) {
    const std::string lit = "[lighting]\nrelight = \"lit\"\n[[light]]\n";
    expect_problem_with(lit + "color = [1, 1, 1]\n", 7, {"[[light]] 1 needs the key \"kind\""});
    expect_problem_with(lit + "kind = \"point\"\n", 7, {"needs the key \"position\""});
    expect_problem_with(lit + "kind = \"sun\"\ndirection = [0, 0, 0]\n", 9, {"must not be zero"});
    expect_problem_with(lit + "kind = \"sun\"\ndirection = [0, 0, 1]\ncolor = [1, -1, 1]\n", 10, {"at least 0"});
    expect_problem_with(lit + "kind = \"spot\"\ndirection = [0, 0, 1]\nposition = [0, 0, 0]\nouter_angle = 20\n", 11,
                        {"inner_angle (22.92) less than outer_angle (20 degrees"});
}

TEST_F(BadScene, NamesAreUnique) {
    expect_problem_with(noise("name = \"dirt\"\n") + noise("name = \"dirt\"\n"), 10, {"\"dirt\"", "layer at line 7"});
    expect_problem_with(noise("name = \"noise 2\"\n") + noise(""), 8, {"\"noise 2\"", "layer at line 7"});
}

TEST_F(BadScene, AllProblemsAtOnceInTheOrderOfTheFile) {
    const std::vector<std::string> found = problems(R"([[layer]]
kind = "noise"
octaves = 99
gian = 1
[[layer]]
kind = "height_map"
uv = { rotation = "left", scal = 1 }
[gbuffer]
file = "none.exr"
[output]
png = 1
)");
    ASSERT_EQ(found.size(), 7u) << testing::PrintToString(found);
    const char* const rest[] = {":3: \"octaves\"",  ":4: unknown key \"gian\"", ":5: [[layer]] \"height_map 2\" needs",
                                ":7: \"rotation\"", ":7: unknown key \"scal\"", ":9: \"file\" in [gbuffer]",
                                ":11: \"png\""};
    for (std::size_t i = 0; i < std::size(rest); ++i)
        EXPECT_EQ(found[i].rfind("courtyard.toml" + std::string(rest[i]), 0), 0u) << found[i];
}

}  // namespace
}  // namespace wrinkle
