#include <cmath>
#include <nlohmann/json.hpp>

#include "io/gbuffer_reader.h"
#include "tests/cli/cli.h"

namespace wrinkle::test {
namespace {

/// Planes of a frame or of an output, each in full.
std::map<std::string, std::vector<float>> planes_of(const GBufferReader& reader,
                                                    const std::vector<std::string>& names) {
    std::map<std::string, std::vector<float>> planes;
    std::vector<float*> out;
    for (const auto& name : names) planes[name].resize(std::size_t{reader.size().width} * reader.size().height);
    for (const auto& name : names) out.push_back(planes[name].data());
    reader.read_rows(0, reader.size().height, names, out);
    return planes;
}

const std::vector<std::string> normal{"normal.x", "normal.y", "normal.z"};

double angle(const std::map<std::string, std::vector<float>>& a, const std::map<std::string, std::vector<float>>& b,
             std::size_t pixel) {
    double dot = 0, aa = 0, bb = 0;
    for (const auto& axis : normal) {
        const double x = a.at(axis)[pixel], y = b.at(axis)[pixel];
        dot += x * y, aa += x * x, bb += y * y;
    }
    return std::acos(std::clamp(dot / std::sqrt(aa * bb), -1.0, 1.0)) * 180 / 3.14159265358979;
}

// What the exporter wrote of Blender 5's default scene, whose cube has a Bump node, against what Cycles makes of that
// node.
TEST(BlenderExport, ARecordedSceneRunsAndBumpsAsBlenderDoes) {
    const Workplace place;
    const fs::path recorded = data_folder / "blender/recorded";
    const Ran ran = place.run("run '" + (recorded / "scene.toml").string() + "' -o out --json");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto report = nlohmann::json::parse(ran.out);
    EXPECT_TRUE(report.at("warnings").empty()) << ran.out;
    expect_mentions(report.at("cameras")[0].get<std::string>(), {"frame.0001.camera.json", "reproject within 0.0"});
    EXPECT_EQ(place.files("out").size(), 5u);

    GBufferSource source;
    source.layer = "wrinkle_data";
    const auto flat = planes_of(GBufferReader(recorded / "frame.0001.exr", source), normal);
    const auto truth = planes_of(GBufferReader(recorded / "rerendered.exr", source), normal);
    const auto bumped = planes_of(GBufferReader(place / "out/normal.exr"), normal);
    double without = 0, with = 0;
    std::size_t pixels = 0;
    for (std::size_t i = 0; i < flat.at("normal.x").size(); ++i) {
        const double off = angle(flat, truth, i);
        if (!(off > 0.5)) continue;  // no bump, or the background
        without += off * off, with += std::pow(angle(bumped, truth, i), 2), ++pixels;
    }
    EXPECT_GT(pixels, 100u);
    EXPECT_LT(std::sqrt(with), 0.5 * std::sqrt(without)) << pixels << " pixels";
}

TEST(Frames, JsonIsUtf8WhateverNamesHold) {
    const Workplace place;
    write_exr(place / "f.exr", 4, 4, {"N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z", "H\xf6he"});
    const Ran info = place.run("info --json f.exr");
    EXPECT_EQ(info.code, 0) << info.err;
    EXPECT_NO_THROW(nlohmann::json::parse(info.out)) << info.out;
    place.write_scene(tilt);
    const Ran run = place.run("run scene.toml -o 'b\xfcmp' --json");
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_NO_THROW(nlohmann::json::parse(run.out)) << run.out;
}

TEST(Frames, ObjectNumbersOf32BitsAreMaskedByAndPassedThrough) {
    const Workplace place;
    const std::vector<std::uint32_t> ids{16777216, 16777217, 16777218, 7};
    auto spec = make_spec(4, 1, {"N.X", "N.Y", "N.Z", "Z", "id"});
    spec.channelformats.assign(4, OIIO::TypeFloat);
    spec.channelformats.push_back(OIIO::TypeUInt32);
    auto output = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(output->open((place / "f.exr").string(), spec));
    std::vector<float> pixels;
    for (const std::uint32_t id : ids)
        for (const float value : {0.0f, 0.0f, 1.0f, 5.0f, std::bit_cast<float>(id)}) pixels.push_back(value);
    ASSERT_TRUE(output->write_scanlines(0, 1, 0, OIIO::TypeUnknown, pixels.data()));
    ASSERT_TRUE(output->close());
    place.write_scene(tilt + "mask = { object = 16777217 }\n[output]\npassthrough = true\npng = false\n", "f.exr",
                      "eye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov = 10");
    const Ran ran = place.run("run scene.toml -o out --quiet");
    ASSERT_EQ(ran.code, 0) << ran.err;
    const GBufferReader result(place / "out/normal.exr");
    const auto planes = planes_of(result, {"normal.x", "bits:id"});
    for (std::size_t i = 0; i < ids.size(); ++i) {
        EXPECT_EQ(std::bit_cast<std::uint32_t>(planes.at("bits:id")[i]), ids[i]);
        EXPECT_EQ(planes.at("normal.x")[i] != 0, ids[i] == 16777217) << ids[i];
    }
    EXPECT_EQ(result.channel_type("id"), ChannelType::whole);
}

TEST(Frames, OverscanIsKeptWhereItIsWanted) {
    const Workplace place;
    auto spec = make_spec(12, 10, {"N.X", "N.Y", "N.Z", "Z"});
    spec.x = -2, spec.y = -1, spec.full_width = 8, spec.full_height = 8;
    write_image(place / "f.exr", {{spec, [](int c, int, int) { return c == 2 ? 1.0f : c == 3 ? 5.0f : 0.0f; }}});
    const std::string noise = "[[layer]]\nkind = \"noise\"\nscale = 0.1\n[output]\n";
    const std::string camera = "eye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov = 40";
    const auto run = [&](const std::string& name, const std::string& more) {
        place.write_scene(noise, "f.exr\"" + more + " # ", camera);
        const Ran ran = place.run("run scene.toml -o " + name + " --quiet");
        EXPECT_EQ(ran.code, 0) << ran.err;
    };
    run("cut", "");
    run("kept", "\noverscan = true");
    const GBufferReader cut(place / "cut/normal.exr");
    GBufferSource source;
    source.overscan = true;
    const GBufferReader kept(place / "kept/normal.exr", source);
    EXPECT_EQ(cut.size(), (Size{8, 8}));
    EXPECT_EQ(kept.size(), (Size{12, 10}));
    EXPECT_EQ(kept.window().x, -2);
    const auto inner = planes_of(cut, normal), all = planes_of(kept, normal);
    for (const auto& axis : normal)
        for (std::size_t y = 0; y < 8; ++y)
            for (std::size_t x = 0; x < 8; ++x)
                EXPECT_NEAR(inner.at(axis)[8 * y + x], all.at(axis)[12 * (y + 1) + x + 2], 1e-5);
    EXPECT_NE(all.at("normal.x")[0], 0);
}

TEST(Frames, MissingDigitsOfTextureCoordinatesAreWarnedOf) {
    const Workplace place;
    auto spec = make_spec(8, 8, {"N.X", "N.Y", "N.Z", "Z", "uv.u", "uv.v"});
    spec.channelformats = {OIIO::TypeFloat, OIIO::TypeFloat, OIIO::TypeFloat,
                           OIIO::TypeFloat, OIIO::TypeHalf,  OIIO::TypeHalf};
    write_image(place / "f.exr", {{spec, [](int c, int x, int) {
                                       return c == 2 ? 1.0f : c == 3 ? 5.0f : 0.1f * static_cast<float>(x);
                                   }}});
    place.write_scene(
        "[[layer]]\nkind = \"height_map\"\ntexture = \"" + Workplace::data_file("textures/swell_height.png") + "\"\n",
        "f.exr", "eye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov = 10");
    const Ran ran = place.run("run scene.toml -o out");
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_mentions(ran.err, {"warning", "height_map 1", "the UV pass (uv.u) is 16-bit", "32 bits", "planar"});
    expect_mentions(place.run("info f.exr").out, {"16-bit floats: uv.uv", "the UV pass (uv.u) is 16-bit"});
}

TEST(Frames, TexturesThatLookLikeSomethingElseAreWarnedOf) {
    const Workplace place;
    write_exr(
        place / "n.png", 8, 8, {"R", "G", "B"}, [](int c, int, int) { return c == 2 ? 1.0f : 188.0f / 255; },
        OIIO::TypeUInt8);
    const std::string layer = "[[layer]]\nkind = \"normal_map\"\ntexture = \"n.png\"\n";
    place.write_scene(layer);
    const Ran ran = place.run("run scene.toml");
    EXPECT_EQ(ran.code, 0) << ran.err;
    expect_mentions(ran.err, {"wrinkle: warning: ", "normal_map 1", "n.png", "sRGB's curve"});
    expect_mentions(place.run("info scene.toml").out, {"normal_map 1", "n.png", "sRGB's curve"});
    place.write_scene(layer + "mask = { channel = \"dirt\" }\n");
    expect_mentions(place.run("info scene.toml").out, {"run refuses the scene: ", "dirt"});
}

TEST(Frames, AlphaGoesOnFromTheFrameOrFromTheFileOfItsBeauty) {
    const Workplace place;
    const auto data = [](int c, int x, int y) { return c == 2 ? 1.0f : c == 3 ? 5.0f : 0.001f * numbered(c, x, y); };
    write_exr(place / "data.7.exr", 8, 6, {"N.X", "N.Y", "N.Z", "Z", "R", "G", "B", "A"}, data);
    const auto picture = [](int c, int x, int) { return c == 3 ? static_cast<float>(x) / 8 : 0.25f; };
    write_exr(place / "beauty.7.exr", 8, 6,
              {"VL.Combined.R", "VL.Combined.G", "VL.Combined.B", "VL.Combined.A", "R", "G", "B"}, picture);
    const std::string layer =
        "[[layer]]\nkind = \"constant\"\ngradient = [0, 0, 0]\n"
        "[lighting]\nrelight = \"ratio\"\n[[light]]\nkind = \"sun\"\ndirection = [0.1, 0, -1]\n";
    const auto write = [&](const std::string& beauty) {
        write_text(place / "scene.toml",
                   "[gbuffer]\nfile = \"data.#.exr\"\n" + beauty +
                       "\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nup = [0, 1, 0]\nfov = 10\n" + layer);
    };
    const auto expect_relit = [&](const Pixel& wanted, int green, int alpha) {
        const Ran ran = place.run("run scene.toml --frames 7");
        ASSERT_EQ(ran.code, 0) << ran.err;
        auto got = planes_of(GBufferReader(place / "out/lit.0007.exr"), {"channel:G", "channel:A"});
        for (int i = 0; i < 48; ++i) {
            EXPECT_EQ(got["channel:G"][static_cast<std::size_t>(i)], wanted(green, i % 8, i / 8)) << i;
            EXPECT_EQ(got["channel:A"][static_cast<std::size_t>(i)], wanted(alpha, i % 8, i / 8)) << i;
        }
    };
    write("");
    expect_relit(data, 5, 7);
    write("beauty = { file = \"beauty.#.exr\", layer = \"VL.Combined\" }");
    expect_relit(picture, 1, 3);
    write("beauty = { file = \"beauty.#.exr\", layer = \"Combine\" }");
    expect_failed(place.run("run scene.toml --frames 7"), {"beauty.7.exr", "Combine"});
    write_exr(place / "beauty.7.exr", 8, 5, {"R", "G", "B"}, picture);
    write("beauty = { file = \"beauty.#.exr\" }");
    expect_failed(place.run("run scene.toml --frames 7"), {"beauty.7.exr: the beauty has 8x5 pixels", "8x6"});
}

}  // namespace
}  // namespace wrinkle::test
