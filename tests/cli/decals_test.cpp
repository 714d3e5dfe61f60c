// wrinkle decals, and scenes that read what it wrote.
#include <cmath>

#include "io/camera_file.h"
#include "io/gbuffer_reader.h"
#include "tests/cli/cli.h"
#include "wrinkle/camera.h"

namespace wrinkle::test {
namespace {

std::string decal(const std::string& name, const std::string& texture, const std::string& rest) {
    return fmt::format("[[layer]]\nname = \"{}\"\nkind = \"decal\"\ntexture = \"{}\"\n{}\n", name,
                       Workplace::data_file("textures/" + texture), rest);
}
const std::string seal =
    decal("seal", "seal_height.png", "scale = 0.04\ncenter = [0.30, -2.05, 0.0]\nhalf_size = [0.6, 0.6, 0.25]");
const std::string crack =
    decal("crack", "cracks_height.png", "scale = 0.06\ncenter = [0.75, -1.85, 0.0]\nhalf_size = [0.7, 0.7, 0.25]");
const std::string cloth =
    decal("cloth", "weave_normal.png",
          "content = \"normal\"\ncenter = [2.15, -1.2, 0.45]\naxis_x = [0.95, -0.3, 0]\naxis_y = [0.15, 0.45, 0.88]\n"
          "half_size = [0.5, 0.5, 0.6]\nfalloff = 0.3\nangle_fade = [60, 85]\nmask = { cryptomatte = \"Torus\" }");
const std::string gradient = "[[layer]]\nname = \"stack\"\nkind = \"gradient\"\n";
const std::string from_file = gradient + "file = \"gradients.exr\"\n";
const std::string written = "[output]\nsurface_gradient = true\npng = false\n";

using Vectors = std::array<std::vector<float>, 3>;

Vectors vectors_of(const fs::path& file, const std::string& layer) {
    const GBufferReader reader(file);
    Vectors out;
    std::vector<std::string> names;
    std::vector<float*> into;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        names.push_back("channel:" + layer + "." + "XYZ"[axis]);
        out[axis].resize(std::size_t{reader.size().width} * reader.size().height);
        into.push_back(out[axis].data());
    }
    reader.read_rows(0, reader.size().height, names, into);
    return out;
}

double largest(const Vectors& a) {
    double most = 0;
    for (const auto& axis : a)
        for (const float v : axis) most = std::max(most, std::abs(double(v)));
    return most;
}

void expect_alike(const Vectors& a, const Vectors& b) {
    EXPECT_GT(largest(b), 0.1);
    double gap = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::size_t i = 0; i < a[axis].size(); ++i)
            gap = std::max(gap, std::abs(double(a[axis][i]) - double(b[axis][i])));
    fmt::print("of {:.3g}, off by {:.2e}\n", largest(b), gap);
    EXPECT_LE(gap, 2e-6 * largest(b));
}

class Decals : public testing::Test {
protected:
    void expect_done(const std::string& arguments) const {
        const Ran ran = place_.run(arguments);
        EXPECT_EQ(ran.code, 0) << arguments << ": " << ran.err;
        EXPECT_EQ(ran.err, "") << arguments;
    }
    Vectors run(const std::string& layers) const {
        place_.write_scene(layers + written);
        expect_done("run scene.toml --quiet");
        return vectors_of(place_ / "out/normal.exr", "surface_gradient");
    }
    void accumulate(const std::string& layers) const {
        place_.write_scene(layers);
        expect_done("decals scene.toml --quiet");
    }

    const Workplace place_;
};

TEST_F(Decals, ASplitStackGivesWhatTheWholeGives) {
    const Vectors whole = run(seal + crack + cloth);
    accumulate(tilt + seal + cloth);
    expect_alike(run(from_file + crack), whole);
}

TEST_F(Decals, GradientsOfAnotherProgramMayBeInCameraSpace) {
    accumulate(seal + cloth);
    const Vectors whole = run(from_file), world = vectors_of(place_ / "gradients.exr", "volume_gradient");
    const GBufferReader frame(Workplace::data_file("gbuffer/small.exr"));
    CameraSource source;
    source.file = Workplace::data_file("gbuffer/small.camera.json");
    const Mat4 view = read_camera(source, frame).view;
    write_exr(place_ / "other.exr", 120, 68, {"bump.B", "bump.G", "bump.R", "other.X"}, [&](int c, int x, int y) {
        const std::size_t axis = c == 3 ? 0 : static_cast<std::size_t>(2 - c),
                          i = static_cast<std::size_t>(120 * y + x);
        double v = 0;
        for (std::size_t k = 0; k < 3; ++k) v += view[axis][k] * double(world[k][i]);
        return static_cast<float>(v);
    });
    expect_alike(run(gradient + "file = \"other.exr\"\nspace = \"camera\"\nlayer = \"bump\"\n"), whole);
    expect_alike(run(gradient + "file = \"other.exr\"\nspace = \"camera\"\n"
                                "channels = [\"other.X\", \"bump.G\", \"bump.B\"]\n"),
                 whole);
}

TEST_F(Decals, NeedNoNormals) {
    const std::string frame = Workplace::data_file("gbuffer/small.exr") + "\"\nroles = { normal = \"none\" }  # ";
    place_.write_scene(seal, frame);
    const Ran ran = place_.run("decals scene.toml -o a.exr");
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.out,
              "wrote a.exr: volume gradients of 1 layer, without normals: no angle_fade, footprints as if they faced "
              "the viewer\n");
    EXPECT_GT(largest(vectors_of(place_ / "a.exr", "volume_gradient")), 0.1);
    expect_mentions(*GBufferReader(place_ / "a.exr").metadata().text("wrinkle/space"), {"world"});
    EXPECT_TRUE(GBufferReader(place_ / "a.exr").metadata().text("wrinkle/provenance"));
}

TEST_F(Decals, WhatCannotBeAccumulatedIsTold) {
    place_.write_scene(tilt);
    expect_failed(place_.run("decals scene.toml"), {"scene.toml: no layer is of kind decal or decals"});
    place_.write_scene(seal);
    expect_failed(place_.run("decals scene.toml -o a.png"), {"-o a.png: gradients are written as EXR"});
    expect_failed(place_.run("decals scene.toml --frames 1-2"), {"--frames", "small.exr"});
    fs::copy_file(Workplace::data_file("gbuffer/small.exr"), place_ / "frame.exr");
    place_.write_scene(seal, "frame.exr");
    const std::string before = read_text(place_ / "frame.exr");
    expect_failed(place_.run("decals scene.toml -o ./frame.exr"), {"frame.exr"});
    EXPECT_EQ(read_text(place_ / "frame.exr"), before);
    place_.write_scene(seal + "mode = \"projector\"\n");
    expect_failed(place_.run("decals scene.toml"), {"layer \"seal\": mode = \"projector\" mixes normals"});
    EXPECT_FALSE(fs::exists(place_ / "gradients.exr"));
    place_.write_scene("[[layer]]\nkind = \"resolve\"\n" + seal);
    const Ran doubtful = place_.run("decals scene.toml");
    EXPECT_EQ(doubtful.code, 0);
    expect_mentions(doubtful.err, {"warning", "layer \"seal\" comes after the resolve \"resolve 1\""});
}

TEST_F(Decals, FilesThatDoNotFitTheFrameAreRefused) {
    write_exr(place_ / "small.exr", 8, 6, {"volume_gradient.X", "volume_gradient.Y", "volume_gradient.Z"});
    write_exr(place_ / "other.exr", 120, 68, {"volume_gradients.X", "volume_gradients.Y", "volume_gradients.Z"});
    const auto refused = [&](const std::string& rest, const std::vector<std::string>& parts) {
        place_.write_scene(gradient + rest);
        expect_failed(place_.run("run scene.toml"), parts);
        EXPECT_FALSE(fs::exists(place_ / "out/normal.exr"));
    };
    refused("file = \"small.exr\"\n", {"scene.toml:", "layer \"stack\": small.exr: it has 8x6 pixels", "has 120x68"});
    refused("file = \"other.exr\"\n", {"layer \"stack\": other.exr: no layer \"volume_gradient\"",
                                       "did you mean \"volume_gradients\"?", "channels found:"});
    refused("file = \"other.exr\"\nchannels = [\"a\", \"volume_gradients.Y\", \"volume_gradients.Z\"]\n",
            {"other.exr: no channel \"a\""});
    refused("", {"layer \"stack\": the frame has no layer \"volume_gradient\" of X, Y and Z"});
    refused("file = \"none.exr\"\n", {"\"file\"", "there is no file"});
    refused("channels = [\"a\"]\n", {"\"channels\"", "must name three channels"});
    refused("channels = [\"a\", \"b\", \"c\"]\nlayer = \"d\"\n", {"\"channels\"", "keep one of them"});
    fs::create_directory(place_ / "out");
    write_exr(place_ / "out/normal.exr", 120, 68, {"volume_gradient.X", "volume_gradient.Y", "volume_gradient.Z"});
    place_.write_scene(gradient + "file = \"out/normal.exr\"\n");
    expect_failed(place_.run("run scene.toml"), {"out/normal.exr"});
}

TEST_F(Decals, OfASequenceAreReadFrameByFrame) {
    for (const int frame : {1, 2})
        fs::copy_file(Workplace::data_file("gbuffer/small.exr"), place_ / fmt::format("frame.{}.exr", frame));
    place_.write_scene(seal, "frame.#.exr");
    expect_failed(place_.run("decals scene.toml --frames 1-2"), {"-o \"gradients.exr\" needs a place for the number"});
    expect_done("decals scene.toml --frames 1-2 -o gradients.#.exr --quiet");
    place_.write_scene(gradient + "file = \"gradients.#.exr\"\n" + written);
    expect_failed(place_.run("run scene.toml"), {"gradients.#.exr holds a place for a frame number"});
    place_.write_scene(gradient + "file = \"gradients.#.exr\"\n" + written, "frame.#.exr");
    expect_failed(place_.run("run scene.toml --frames 2-3"), {"no such file", "gradients.3.exr"});
    const auto lines = [&] { return place_.run("run scene.toml --frames 1-2 --resume").err; };
    expect_mentions(lines(), {"frame 1 written", "frame 2 written"});
    write_exr(place_ / "gradients.2.exr", 120, 68, {"volume_gradient.X", "volume_gradient.Y", "volume_gradient.Z"},
              [](int, int, int) { return 0.25f; });
    expect_mentions(lines(), {"frame 1 skipped", "frame 2 written"});
    EXPECT_EQ(largest(vectors_of(place_ / "out/normal.0002.exr", "surface_gradient")) > 0.01, true);
}

TEST_F(Decals, LayersAreWrittenEachByItself) {
    place_.write_scene(seal + crack + tilt + written + "layers = true\n");
    expect_done("run scene.toml --quiet");
    const auto of = [&](const std::string& layer) { return vectors_of(place_ / "out/normal.exr", layer); };
    Vectors sum = of("gradient.seal");
    for (const char* name : {"gradient.crack", "gradient.tilt"}) {
        const Vectors more = of(name);
        EXPECT_GT(largest(more), 0.1) << name;
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t i = 0; i < sum[axis].size(); ++i) sum[axis][i] += more[axis][i];
    }
    expect_alike(sum, of("surface_gradient"));
    EXPECT_GT(largest(of("gradient.seal")), 0.1);
    fs::rename(place_ / "out/normal.exr", place_ / "layers.exr");
    const Vectors crack_alone = vectors_of(place_ / "layers.exr", "gradient.crack");
    expect_alike(run(gradient + "file = \"layers.exr\"\nlayer = \"gradient.crack\"\n"), crack_alone);
}

}  // namespace
}  // namespace wrinkle::test
