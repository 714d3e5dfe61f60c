#include "tests/scene/layer_texts.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using BadLayers = SceneFolder;

TEST_F(BadLayers, NoiseOptionsThatMakeNoSense) {
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

TEST_F(BadLayers, NumbersOutOfRange) {
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

TEST_F(BadLayers, WaysToCombineAndToCompare) {
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

TEST_F(BadLayers, PlanesOfATriplanarProjection) {
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

TEST_F(BadLayers, AxesThatSpanNoPlane) {
    expect_problem_with(decal("axis_x = [0, 2, 0]\n"), 9, {"\"axis_x\"", "parallel"});
    expect_problem_with(decal("axis_x = [0, 0, 0]\n"), 9, {"\"axis_x\"", "zero"});
    expect_problem_with(decal("axis_x = [1, 1, 0]\naxis_y = [-2, -2, 0]\n"), 10, {"\"axis_y\"", "parallel"});
    expect_problem_with(height_map("uv = { source = \"planar\", axis_v = [3, 0, 0] }\n"), 8,
                        {"\"axis_v\"", "parallel"});
}

TEST_F(BadLayers, ObjectNormals) {
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

TEST_F(BadLayers, FramesOfNormalMaps) {
    const auto normal_map = [](const std::string& rest) {
        return layer("kind = \"normal_map\"\ntexture = \"textures/wall.png\"\n" + rest);
    };
    expect_problem_with(normal_map("tangents = \"passed\"\n"), 8,
                        {"did you mean \"passes\"?", "\"auto\", \"derived\", \"passes\""});
    expect_problem_with(normal_map("tangents = \"passes\"\nuv = { rotation = 90 }\n"), 8,
                        {"\"tangents\"", "belong to the UV pass as it is: uv must not be planar or turn"});
    expect_problem_with(normal_map("tangents = \"passes\"\nuv = { source = \"planar\" }\n"), 8,
                        {"\"tangents\"", "UV pass"});
}

TEST_F(BadLayers, KeysWithoutEffect) {
    expect_problem_with(decal("y = \"-\"\n"), 9, {"has an effect only with content = \"normal\""});
    expect_problem_with(decal("content = \"normal\"\nupscale = \"plain\"\n"), 10, {"only with content = \"height\""});
    expect_problem_with(height_map("uv = { axis_u = [1, 0, 0] }\n"), 8, {"only with source = \"planar\""});
    expect_problem_with(noise("mask = { invert = true }\n"), 7, {"needs one of the keys object"});
    expect_problem_with(noise("mask = { object = 1, uv = { scale = 2 } }\n"), 7, {"\"uv\"", "the key \"texture\""});
    expect_problem_with(noise("mask = { cryptomatte = \"#12\" }\n"), 7, {"is \"#12\"", "8 hex digits"});
    expect_problem_with(noise("mask = { cryptomatte = [\"Rock*\", \"#12\"] }\n"), 7, {"is \"#12\"", "8 hex digits"});
    expect_problem_with(noise("mask = { object = [] }\n"), 7, {"must be a number, or an array of numbers"});
    expect_problem_with(noise("mask = { object = [3, \"4\"] }\n"), 7, {"\"object\"", "must be a number"});
    expect_problem_with(noise("mask = { cryptomatte = [\"Rock\", 4] }\n"), 7, {"must be a text"});
    expect_problem_with("[lighting]\nleave = { invert = true }\n", 6,
                        {"leave of [lighting] needs one of the keys object"});
    expect_problem_with("[lighting]\nleave = { object = 1, texture = \"a.png\" }\n", 6, {"unknown key \"texture\""});
    expect_problem_with("[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\n", 5,
                        {"has no effect", "relight = \"lit\""});
    expect_problem_with("[lighting]\nrelight = \"lit\"\n", 6, {"relight without light"});
    expect_problem_with(
        "[lighting]\nrelight = \"ratio\"\n[[light]]\nkind = \"sun\"\ndirection = [0, 0, -1]\n"
        "picture = \"sun\"\nspecular = \"sun_specular\"\n",
        11, {"\"specular\" in [[light]] 1 is a part of what picture shows"});
}

TEST_F(BadLayers, KeysOfAnotherKind) {
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
        10,
        {"[[light]] 1",
         "does not belong to kind \"sun\" but to \"point\", \"spot\", \"sphere\", \"disc\", \"rectangle\""});
}

}  // namespace
}  // namespace wrinkle
