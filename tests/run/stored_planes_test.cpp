// Passes on planes as engines hold them: what they compute is what they compute of the numbers that are stored.
#include <random>

#include "tests/run/decal_frames.h"
#include "tests/run/stored_frame.h"

namespace wrinkle::test {
namespace {

using enum PlaneEncoding;

const V slanted = normalize(V{0.1, -0.2, 1});

/// Normals that differ from pixel to pixel a little, and some background.
HostFrame bent_frame(Size size) {
    HostFrame frame(plane_frame(test_camera(), size, slanted), test_camera());
    std::mt19937 random(5);
    std::normal_distribution<float> part(0, 0.05f);
    for (const char* axis : {"normal.x", "normal.y", "normal.z"})
        for (float& v : frame.pixels.at(axis)) v += part(random);
    for (std::size_t i = 3; i < frame.count(); i += 41) frame.pixels.at("depth")[i] = INFINITY;
    return frame;
}

/// Gradients that come in planes, resolved.
Scene resolve_scene() {
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "gradients";
    scene.layers[0].bump = GradientLayer{.channels = {"g.X", "g.Y", "g.Z"}};
    scene.filter.taps = 1;
    scene.output = {.surface_gradient = true, .marked = true};
    return scene;
}

HostFrame resolve_frame() {
    HostFrame frame = bent_frame({61, 19});
    frame.remove("uv.u"), frame.remove("uv.v");
    std::mt19937 random(6);
    std::normal_distribution<float> part(0, 0.3f);
    for (const char* axis : {"channel:g.X", "channel:g.Y", "channel:g.Z"})
        for (float& v : frame.add(axis)) v = part(random);
    return frame;
}

const std::vector<std::string> kNormal{"normal.x", "normal.y", "normal.z"},
    kGradient{"channel:g.X", "channel:g.Y", "channel:g.Z"};

std::vector<std::string> with_gap(std::vector<std::string> names, std::size_t at) {
    names.insert(names.begin() + static_cast<std::ptrdiff_t>(at), "");
    return names;
}

TEST(StoredPlanes, AreReadInEveryFormat) {
    const struct {
        const char* what;
        PlaneFormats formats;
        int lanes;
        double bytes;  ///< a pixel, of all that is read
    } cases[] = {
        {"RGBA8 normals, half gradients, half depth",
         merged({interleaved("a", unorm8, with_gap(kNormal, 3), 2, -1),
                 interleaved("b", half, with_gap(kGradient, 0)),
                 {{"depth", {.encoding = half}}}}),
         16, 4 + 8 + 2},
        {"RGBA8 normals on one lane", interleaved("a", snorm8, with_gap(kNormal, 0)), 1, 4 + 16},
        {"2 x 8 octahedral normals, RGBA32F gradients",
         merged({interleaved("a", octahedral8, kNormal), interleaved("b", float32, with_gap(kGradient, 1))}), 16,
         2 + 16 + 4},
        {"2 x 16 octahedral normals, planar 16-bit gradients, depth of 10 m",
         merged({interleaved("a", octahedral16, kNormal),
                 {{"channel:g.X", {.encoding = snorm16, .scale = 2}},
                  {"channel:g.Y", {.encoding = unorm16, .scale = 4, .bias = -2}},
                  {"channel:g.Z", {.encoding = half}},
                  {"depth", {.encoding = unorm16, .scale = 10}}}}),
         8, 4 + 2 + 2 + 2 + 2},
        {"packed RGB16 normals and gradients, of six bytes and of twelve",
         merged({interleaved("a", snorm16, kNormal), interleaved("b", float32, kGradient)}), 16, 6 + 12 + 4},
        {"mixed pixels of 16 bytes",
         {{"normal.x", {.encoding = snorm16, .offset = 2, .stride = 16, .memory = "all"}},
          {"normal.y", {.encoding = snorm16, .offset = 0, .stride = 16, .memory = "all"}},
          {"normal.z", {.encoding = snorm16, .offset = 14, .stride = 16, .memory = "all"}},
          {"depth", {.encoding = float32, .offset = 8, .stride = 16, .memory = "all"}},
          {"channel:g.Z", {.encoding = half, .offset = 12, .stride = 16, .memory = "all"}}},
         4,
         16 + 8},
    };
    for (const auto& each : cases) {
        HostFrame given = resolve_frame();
        // A direction tells no background, and neither does a depth of integers.
        if (each.formats.contains("depth") && each.formats.at("depth").encoding == unorm16)
            std::ranges::replace(given.pixels.at("depth"), INFINITY, 0.0f);
        const StoredFrame frame(given, each.formats);
        Pass pass = evaluate(device(), resolve_scene(), frame.frame, {.lanes = each.lanes});
        const Pixels got = run(pass, frame);
        const Truth truth(frame.decoded, resolve_scene());
        EXPECT_EQ(marked_differences(got, truth), 0u) << each.what;
        EXPECT_EQ(pass.bytes_per_pixel(), each.bytes + 4 * 7) << each.what;
        std::vector<double> errors;
        for (std::size_t i = 0; i < truth.pixels.size(); ++i)  // octahedral ones of invalid pixels pass at any length
            errors.push_back(angle_degrees(vec_at(got, "normal", i), truth.pixels[i].normal));
        expect_within(each.what, Spread(std::move(errors)), {1e-5, 3e-5, 6e-5}, "degrees");
    }
}

/// Texture coordinates need neighbours, of planes in other formats each.
TEST(StoredPlanes, AreReadAsNeighbours) {
    HostFrame given = bent_frame({61, 19});
    for (float& v : given.add("object")) v = 20000000;
    for (std::size_t i = 0; i < given.count(); i += 7) given.pixels.at("object")[i] = 3;
    const PlaneFormats formats = merged({interleaved("a", octahedral16, kNormal),
                                         {{"uv.u", {.encoding = unorm16, .scale = 4, .bias = -2}},
                                          {"object", {.encoding = uint32}},
                                          {"depth", {.offset = 4, .stride = 8, .memory = "d"}}}});
    const StoredFrame frame(given, formats);
    Scene scene;
    scene.filter.taps = 1;
    scene.layers.resize(2);
    scene.layers[0].name = "weave";
    NormalMapLayer weave;
    weave.texture.file = data_folder / "textures/weave_normal.png";
    scene.layers[0].bump = weave;
    scene.layers[1] = scene.layers[0];
    scene.layers[1].name = "of object 20000000", scene.layers[1].mask.object = {20000000};
    scene.output.marked = true;
    Pass pass = evaluate(device(), scene, frame.frame);
    const Pixels got = run(pass, frame);
    const Truth truth(frame.decoded, scene);
    EXPECT_EQ(marked_differences(got, truth), 0u);
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        errors.push_back(angle_degrees(vec_at(got, "normal", i), truth.pixels[i].normal));
    expect_within("neighbours", Spread(std::move(errors)), {1e-4, 1e-3, 3e-3}, "degrees");
}

/// Tables of decals measure tiles by the planes, and evaluate blocks of pixels.
TEST(StoredPlanes, AreReadByTablesOfDecals) {
    const HostFrame given = bent_frame({67, 33});
    const StoredFrame frame(given, merged({interleaved("a", half, with_gap(kNormal, 3)),
                                           {{"depth", {.offset = 8, .stride = 12, .memory = "d"}}}}));
    const Scene scene = table_scene(on_surfaces(frame.decoded, 60, 0.2, 1, 3));
    Pass pass = evaluate(device(), scene, frame.frame);
    EXPECT_EQ(largest_difference(run(pass, frame), evaluate_on(frame.decoded, scene)), 0);
}

/// The pass without normals leaves out their formats, too.
TEST(StoredPlanes, NormalsOfAnyFormatAreLeftOutOfSumsOfDecals) {
    const HostFrame given = bent_frame({33, 9});
    const StoredFrame frame(given, interleaved("a", half, with_gap(kNormal, 3)));
    const Scene scene = table_scene(on_surfaces(frame.decoded, 20, 0.2, 1, 3));
    Pass pass = accumulate_decals(device(), scene.layers, frame.frame);
    Pass plain = accumulate_decals(device(), scene.layers, given.frame);
    EXPECT_EQ(largest_difference(run(pass, frame), run(plain, given)), 0);
}

/// Pixels of six bytes, which no vector is stored to at once.
TEST(StoredPlanes, AreWrittenToPixelsInMemoryThatIsLent) {
    const HostFrame frame = resolve_frame();
    Pass pass =
        evaluate(device(), resolve_scene(), frame.frame,
                 {.lanes = lanes_to_try({16, 8, 4, 1}).front(), .output_formats = interleaved("a", half, kNormal)});
    const std::size_t pixels = padded(frame.count());
    DevicePlanes in, out;
    for (const std::string& name : pass.inputs()) {
        in[name] = cl::Buffer(device().context, CL_MEM_READ_ONLY, pixels * sizeof(float));
        std::vector<float> plane = frame.pixels.at(name);
        device().queue.enqueueWriteBuffer(in[name], CL_TRUE, 0, plane.size() * sizeof(float), plane.data());
    }
    std::vector<std::uint32_t> lent(pixels * 6 / 4 + 1);
    for (const std::string& name : pass.outputs())
        out[name] = name == "a" ? cl::Buffer(device().context, CL_MEM_WRITE_ONLY | CL_MEM_USE_HOST_PTR, pixels * 6,
                                             lent.data() + 1)
                                : cl::Buffer(device().context, CL_MEM_WRITE_ONLY, pixels * sizeof(float));
    pass.enqueue(in, out).wait();
    EXPECT_NE(lent[1 + 6 * (frame.count() / 2) / 4], 0u) << "the middle of the frame";
}

TEST(StoredPlanes, AreWrittenInEveryFormat) {
    const HostFrame frame = resolve_frame();
    const Pixels plain = evaluate_on(frame, resolve_scene());
    const std::vector<std::string> gradient{"surface_gradient.x", "surface_gradient.y", "surface_gradient.z"};
    const PlaneFormats sets[] = {
        merged({interleaved("a", half, with_gap(kNormal, 3)),
                {{"surface_gradient.x", {.encoding = half}},
                 {"surface_gradient.y", {.encoding = snorm16, .scale = 4}},
                 {"surface_gradient.z", {.encoding = snorm8, .scale = 4}},
                 {"marked", {.encoding = uint32}}}}),
        merged({interleaved("a", octahedral16, kNormal), interleaved("b", unorm16, with_gap(gradient, 0), 8, -4)}),
        merged({interleaved("a", octahedral8, kNormal),
                interleaved("b", float32, gradient),
                {{"marked", {.encoding = unorm8, .scale = 255}}}}),
    };
    int lanes = 16;
    for (const PlaneFormats& formats : sets) {
        PassOptions options{.lanes = lanes, .output_formats = formats};
        lanes = lanes == 16 ? 1 : 8;
        Pass pass = evaluate(device(), resolve_scene(), frame.frame, options);
        std::map<std::string, std::vector<std::byte>> memory;
        HostBytes in;
        HostByteOutputs out;
        for (const auto& [name, plane] : frame.pixels) in[name] = std::as_bytes(std::span(plane));
        for (const std::string& name : pass.outputs()) {
            memory[name].resize(16 * frame.count(), std::byte{0x5a});
            out[name] = memory[name];
        }
        pass.run(in, out);
        double degrees = 0;
        for (const auto& [name, plane] : plain) {
            PlaneFormat format = formats.contains(name) ? formats.at(name) : PlaneFormat{.memory = name};
            const bool octahedral = format.encoding == octahedral8 || format.encoding == octahedral16;
            for (std::size_t i = 0; i < plane.size(); ++i) {
                const std::uint32_t got =
                    reference::stored(memory.at(format.memory.empty() ? name : format.memory), format, i);
                if (octahedral) {
                    const V n = reference::decoded_normal(format.encoding, got);
                    const double off = angle_degrees(n, vec_at(plain, "normal", i));
                    ASSERT_TRUE(std::isfinite(off)) << i;
                    degrees = std::max(degrees, off);
                    continue;
                }
                const double number = (static_cast<double>(plane[i]) - format.bias) / format.scale;
                const std::uint32_t want = reference::encoded(format.encoding, number);
                const double off = reference::decoded(format.encoding, got) - reference::decoded(format.encoding, want);
                // A number half way between two integers may become either.
                const double step = format.encoding == snorm8 ? 1 / 127.0 : format.encoding == half ? 0 : 1.01 / 32767;
                ASSERT_LE(std::abs(off), format.encoding == float32 || format.encoding == uint32 ? 0 : step)
                    << name << ' ' << i << ": " << got << ", " << want;
            }
        }
        EXPECT_LE(degrees, formats.at("normal.x").encoding == octahedral8 ? 0.95 : 0.0037);
        if (formats.at("normal.x").encoding != half) continue;
        for (std::size_t i = 0; i < frame.count(); ++i)  // the fourth number of the pixels was nobody's
            EXPECT_EQ(memory.at("a")[8 * i + 7], std::byte{0x5a});
    }
}

TEST(StoredPlanes, CannotBeGivenAsFloats) {
    const HostFrame frame = resolve_frame();
    Frame stored = frame.frame;
    stored.formats["depth"] = {.encoding = half};
    Pass pass = evaluate(device(), resolve_scene(), stored, {.lanes = 1});
    try {
        run(pass, frame);
        FAIL() << "was accepted";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("\"depth\" is half"), std::string::npos) << error.what();
    }
    std::vector<std::byte> little(2 * frame.count() - 1);
    HostBytes in;
    for (const auto& [name, plane] : frame.pixels) in[name] = std::as_bytes(std::span(plane));
    in["depth"] = little;
    EXPECT_THROW(pass.run(in, HostByteOutputs{}), Error);
    if (device().info.fp64) {
        EXPECT_THROW(evaluate(device(), resolve_scene(), frame.frame,
                              {.fp64 = true, .output_formats = {{"marked", {.encoding = unorm8}}}}),
                     Error);
    }
}

}  // namespace
}  // namespace wrinkle::test
