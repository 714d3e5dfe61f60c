#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using BadScene = SceneFolder;

std::string layer(const std::string& rest) { return "[[layer]]\n" + rest; }
std::string noise(const std::string& rest) { return layer("kind = \"noise\"\n" + rest); }
std::string decal(const std::string& rest) {
    return layer("kind = \"decal\"\ntexture = \"textures/wall.png\"\ncenter = [0, 0, 0]\n" + rest);
}
std::string height_map(const std::string& rest) {
    return layer("kind = \"height_map\"\ntexture = \"textures/wall.png\"\n" + rest);
}

std::string parallax(const std::string& rest) {
    return layer("kind = \"parallax\"\ntexture = \"textures/wall.png\"\n" + rest);
}

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
                  (folder_ / "courtyard.toml").string() + ": the scene is empty; it needs [gbuffer] and [camera]");
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

TEST_F(BadScene, Budgets) {
    expect_problem_with("[budget]\nsample = 10\n", 5, {"[budget]", "max_error"});
    for (const char* value : {"0", "-0.1", "181", "inf", "nan", "\"small\""})
        expect_problem_with(std::string("[budget]\nmax_error = ") + value + "\n", 6, {"max_error", "[budget]"});
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
    expect_problem_with("[output]\nxyzzy = true\n", 6, {"unknown key \"xyzzy\" in [output]; known keys: surface_grad"});
    expect_problem_with("[lighting]\nambiant = [1, 1, 1]\n", 6, {"[lighting]", "\"ambient\"?"});
    expect_problem_with(height_map("uv = { scal = 2 }\n"), 8, {"uv of [[layer]] \"height_map 1\"", "\"scale\"?"});
    expect_problem_with(noise("\n[layer.mask]\nobjekt = 2\nobject = 2\n"), 9,
                        {"mask of [[layer]] \"noise 1\"", "\"object\"?"});
    expect_problem_with("[gbuffer.roles]\npositoin = \"P\"\n", 6, {"roles of [gbuffer]", "\"position\"?"});
    expect_problem_with("[gbuffer.roles]\nposition.w = \"P.A\"\n", 6,
                        {"\"w\" in position of roles of [gbuffer]", "x, y, z"});
    expect_problem_with("\"a\\nb\" = 1\n", 5, {"unknown key \"a\\x0ab\""});
}

TEST_F(BadScene, NoiseOptionsThatMakeNoSense) {
    expect_problem_with(noise("feature = \"f2\"\n"), 7, {"\"feature\"", "only with type = \"worley\""});
    expect_problem_with(noise("rotation = 4\n"), 7, {"\"rotation\"", "only with type = \"simplex\""});
    expect_problem_with(noise("type = \"worley\"\nperiod = [1, 1, 1]\n"), 8, {"only with type = \"simplex\""});
    expect_problem_with(noise("feedback = 1\n"), 7, {"\"feedback\"", "only with fractal = \"ridged\""});
    expect_problem_with(noise("type = \"worley\"\nfractal = \"ridged\"\n"), 8, {"\"fractal\"", "use \"sum\""});
    expect_problem_with(noise("type = \"simplex\"\nperiod = [1, 2.5, 0]\n"), 8, {"\"period\"", "whole numbers"});
    expect_problem_with(noise("type = \"simplex\"\noctaves = 2\nlacunarity = 2.5\nperiod = [4, 4, 4]\n"), 10,
                        {"\"period\"", "whole lacunarity; it is 2.5"});
    expect_problem_with(noise("type = \"simplex\"\noctaves = 16\nperiod = [99, 0, 0]\n"), 9, {"\"period\"", "at most"});
    expect_problem_with(noise("shape = { power = 0.5 }\n"), 7, {"\"power\"", "shape of [[layer]]"});
    expect_problem_with(noise("shape = { bias = 1 }\n"), 7, {"\"bias\""});
    expect_problem_with(noise("shape = { remap = [2, 2] }\n"), 7, {"\"remap\"", "the smaller number first"});
    expect_problem_with(noise("shape = { power = 2, bias = 0.5 }\n"), 7, {"more than one", "choose one"});
}

TEST_F(BadScene, KeysOfAnotherKind) {
    expect_problem_with(decal("octaves = 3\n"), 9,
                        {"\"octaves\" in [[layer]] \"decal 1\" does not belong to kind \"decal\" but to \"noise\"",
                         "known keys: name, kind, texture"});
    expect_problem_with(layer("kind = \"resolve\"\ntexture = \"textures/wall.png\"\n"), 7,
                        {"does not belong to kind \"resolve\"", "\"normal_map\"", "known keys: name, kind"});
    expect_problem_with(layer("kind = \"resolve\"\nscale = 2\n"), 7, {"\"scale\"", "does not belong"});
    expect_problem_with(height_map("y = \"-\"\n"), 8, {"does not belong to kind \"height_map\" but to \"normal_map\""});
    expect_problem_with(
        "[lighting]\nrelight = \"lit\"\n[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\nposition = [0, 0, "
        "1]\n",
        10, {"[[light]] 1", "does not belong to kind \"sun\" but to \"point\", \"spot\""});
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

TEST_F(BadScene, NumbersOutOfRange) {
    for (const char* number : {"inf", "-inf", "nan"}) {
        expect_problem_with(noise("scale = " + std::string(number) + "\n"), 7, {"must be a finite number; found "});
        expect_problem_with(layer("kind = \"constant\"\ngradient = [0, " + std::string(number) + ", 0]\n"), 7,
                            {"each element a finite number"});
    }
    expect_problem_with(noise("scale = 1e39\n"), 7, {"32-bit"});
    expect_problem_with(noise("frequency = 1e-40\n"), 7, {"32-bit"});
    expect_problem_with(noise("frequency = 0\n"), 7, {"must be greater than 0 and at most 1000000000; found 0"});
    expect_problem_with(noise("octaves = 0\n"), 7, {"from 1 to 16; found 0"});
    expect_problem_with(noise("octaves = 17\n"), 7, {"from 1 to 16; found 17"});
    expect_problem_with(noise("octaves = 4294967297\n"), 7, {"from 1 to 16"});
    expect_problem_with(layer("kind = \"triplanar\"\ntexture = \"textures/wall.png\"\ntile = -1.0\n"), 8,
                        {"\"tile\"", "must be greater than 0; found -1.0"});
    expect_problem_with(decal("falloff = 1.5\n"), 9, {"must be at least 0 and at most 1; found 1.5"});
    expect_problem_with(decal("half_size = [1, 0, 1]\n"), 9, {"each element greater than 0; found 0"});
    expect_problem_with(decal("angle_fade = [75, 60]\n"), 9, {"smaller angle first"});
    expect_problem_with(decal("angle_fade = [75, 190]\n"), 9, {"at most 180; found 190"});
    expect_problem_with(height_map("uv = { scale = [1, 0] }\n"), 8, {"must not be 0"});
    expect_problem_with(parallax("scale = 0\n"), 8, {"\"scale\"", "must be greater than 0 and at most 1000000"});
    expect_problem_with(parallax("steps = 0\n"), 8, {"from 1 to 1024; found 0"});
    expect_problem_with(parallax("refine = 17\n"), 8, {"from 0 to 16; found 17"});
    expect_problem_with(parallax("level = 1.5\n"), 8, {"must be at least 0 and at most 1; found 1.5"});
    expect_problem_with("[lighting]\nmax_ratio = 0.5\n", 6, {"must be at least 1"});
}

TEST_F(BadScene, WaysToCombineAndToCompare) {
    const auto triplanar = [](const std::string& rest) {
        return layer("kind = \"triplanar\"\ntexture = \"textures/wall.png\"\n" + rest);
    };
    expect_problem_with(layer("kind = \"normal_map\"\ntexture = \"textures/wall.png\"\ncombine = \"rmn\"\n"), 8,
                        {"is \"rmn\"; did you mean \"rnm\"?", "\"whiteout\""});
    expect_problem_with(layer("kind = \"height_channel\"\n"), 5, {"needs the key \"channel\""});
    expect_problem_with(decal("mode = \"projektor\"\n"), 9, {"did you mean \"projector\"?"});
    expect_problem_with(height_map("upscale = \"taps\"\nwrap = \"clamp\"\n"), 8, {"\"taps\", which repeats"});
    expect_problem_with(triplanar("upscale = \"taps\"\n"), 8, {"\"plain\", \"smooth\""});
    expect_problem_with(height_map("project = false\n"), 8, {"does not belong to kind \"height_map\" but to"});
    expect_problem_with(triplanar("mode = \"geiss\"\n"), 8, {"only with content = \"normal\""});
    expect_problem_with(triplanar("mode = \"perlim\"\n"), 8, {"did you mean \"perlin\"?"});
    expect_problem_with(triplanar("origin = [0, 0]\n"), 8, {"\"lower_left\", \"upper_left\""});
    expect_problem_with(triplanar("transform = { scale = [1, 0, 1] }\n"), 8, {"from 1e-6 to 1e6"});
    expect_problem_with(triplanar("transform = { rotation = [1, 0, 1] }\n"), 8,
                        {"transform of [[layer]] \"triplanar 1\"", "translate, rotate, scale"});
}

TEST_F(BadScene, PlanesOfATriplanarProjection) {
    const auto triplanar = [](const std::string& rest) {
        return layer("kind = \"triplanar\"\ntexture = \"textures/wall.png\"\n" + rest);
    };
    const auto plane = [&](const std::string& text) { return triplanar("planes = { x = { " + text + " } }\n"); };
    expect_problem_with(triplanar("planes = { w = { noise = {} } }\n"), 8,
                        {"planes of [[layer]] \"triplanar 1\"", "known keys: x, y, z"});
    expect_problem_with(plane("scale = 2"), 8, {"plane x of [[layer]] \"triplanar 1\"", "needs the key \"texture\""});
    expect_problem_with(plane("noise = { octaves = 0 }"), 8, {"noise of plane x of", "from 1 to 16; found 0"});
    expect_problem_with(plane("noise = { scale = 2 }"), 8, {"noise of plane x of", "unknown key \"scale\""});
    expect_problem_with(plane("noise = {}, texture = \"textures/wall.png\""), 8, {"\"noise\" exclude each other"});
    expect_problem_with(plane("texture = \"textures/wall.png\", slopes = \"texel\""), 8,
                        {"\"slopes\"", "content", "slope"});
    expect_problem_with(plane("texture = \"textures/wall.png\", y = \"-\""), 8, {"\"normal\" or \"slope\""});
    expect_problem_with(triplanar("content = \"object_normal\"\nmode = \"perlin\"\n"), 9,
                        {"must be \"surface_gradient\" with content = \"object_normal\""});
    expect_problem_with(triplanar("content = \"normal\"\nmode = \"geiss\"\nplanes = { x = { noise = {} } }\n"), 9,
                        {"only with content = \"normal\""});
    expect_problem_with(triplanar("planes = { x = { noise = {} }, y = { noise = {} }, z = { noise = {} } }\n"), 7,
                        {"\"texture\"", "\"planes\" names all three"});
}

TEST_F(BadScene, AxesThatSpanNoPlane) {
    expect_problem_with(decal("axis_x = [0, 2, 0]\n"), 9, {"\"axis_x\"", "parallel"});
    expect_problem_with(decal("axis_x = [0, 0, 0]\n"), 9, {"\"axis_x\"", "zero"});
    expect_problem_with(decal("axis_x = [1, 1, 0]\naxis_y = [-2, -2, 0]\n"), 10, {"\"axis_y\"", "parallel"});
    expect_problem_with(height_map("uv = { source = \"planar\", axis_v = [3, 0, 0] }\n"), 8,
                        {"\"axis_v\"", "parallel"});
}

TEST_F(BadScene, ObjectNormals) {
    const auto object_normal = [](const std::string& rest) {
        return layer("kind = \"object_normal\"\ntexture = \"textures/wall.png\"\n" + rest);
    };
    for (const char* text : {"x y", "x y z w", "x y x", "x y w", "xyz", "x y --z", "x y +"})
        expect_problem_with(object_normal("channels = \"" + std::string(text) + "\"\n"), 8,
                            {"\"channels\"", "must name each axis once, as \"x -z y\" does"});
    expect_problem_with(object_normal("object_to_world = [[1, 0, 0], [0, 1, 0]]\n"), 8,
                        {"must be a 3x3 matrix, [[..], [..], [..]] with 3 numbers a row"});
    expect_problem_with(object_normal("object_to_world = [[1, 0, 0], [0, 1, 0], [1, 1, 0]]\n"), 8,
                        {"\"object_to_world\"", "must not flatten the object"});
    expect_problem_with(object_normal("space = \"world\"\nobject_to_world = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\n"), 9,
                        {"\"object_to_world\"", "space", "object"});
}

TEST_F(BadScene, FramesOfNormalMaps) {
    const auto normal_map = [](const std::string& rest) {
        return layer("kind = \"normal_map\"\ntexture = \"textures/wall.png\"\n" + rest);
    };
    expect_problem_with(normal_map("frame = \"tangent\"\n"), 8,
                        {"did you mean \"tangents\"?", "\"auto\", \"derived\", \"tangents\""});
    expect_problem_with(normal_map("frame = \"tangents\"\nuv = { rotation = 90 }\n"), 8,
                        {"\"frame\"", "belongs to the UV pass as it is: uv must not be planar or turn"});
    expect_problem_with(normal_map("frame = \"tangents\"\nuv = { source = \"planar\" }\n"), 8,
                        {"\"frame\"", "UV pass"});
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
                        {"frame patterns are for"});
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
    expect("max_residual = 1\n", 3, {"[camera] needs one of: file | from = \"exr\" | view and proj | eye, target"});
    expect("file = \"camera.json\"\n" + view + proj, 5, {"\"view\"", "again, beside \"file\" at line 4"});
    expect("eye = [0, 0, 0]\ntarget = [1, 0, 0]\nfov = 40\nfrom = \"exr\"\n", 4,
           {"\"eye\"", "beside \"from\" at line 7"});
    expect(view, 3, {"needs the key \"proj\""});
    expect(proj, 3, {"needs the key \"view\""});
    expect("eye = [0, 0, 0]\ntarget = [1, 0, 0]\n", 3, {"needs the key \"fov\""});
    expect("from = \"json\"\n", 4, {"allowed: \"exr\""});
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

TEST_F(BadScene, KeysWithoutEffect) {
    expect_problem_with(decal("y = \"-\"\n"), 9, {"has an effect only with content = \"normal\""});
    expect_problem_with(decal("content = \"normal\"\nupscale = \"plain\"\n"), 10, {"only with content = \"height\""});
    expect_problem_with(height_map("uv = { axis_u = [1, 0, 0] }\n"), 8, {"only with source = \"planar\""});
    expect_problem_with(noise("mask = { invert = true }\n"), 7, {"needs one of the keys object"});
    expect_problem_with(noise("mask = { object = 1, uv = { scale = 2 } }\n"), 7, {"\"uv\"", "the key \"texture\""});
    expect_problem_with(noise("mask = { cryptomatte = \"#12\" }\n"), 7, {"is \"#12\"", "8 hex digits"});
    expect_problem_with("[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\n", 5,
                        {"has no effect", "relight = \"lit\""});
    expect_problem_with("[lighting]\nrelight = \"lit\"\n", 6, {"relight without light"});
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
    ASSERT_EQ(found.size(), 8u) << testing::PrintToString(found);
    EXPECT_EQ(found[0], "courtyard.toml: needs [camera], at least from = \"exr\"");
    const char* const rest[] = {":3: \"octaves\"",  ":4: unknown key \"gian\"", ":5: [[layer]] \"height_map 2\" needs",
                                ":7: \"rotation\"", ":7: unknown key \"scal\"", ":9: \"file\" in [gbuffer]",
                                ":11: \"png\""};
    for (std::size_t i = 0; i < std::size(rest); ++i)
        EXPECT_EQ(found[i + 1].rfind("courtyard.toml" + std::string(rest[i]), 0), 0u) << found[i + 1];
}

}  // namespace
}  // namespace wrinkle
