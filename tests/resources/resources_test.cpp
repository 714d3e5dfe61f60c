// What programs with kernels of their own get of wrinkle/resources.h is what the library's own kernels read.
#include "wrinkle/resources.h"

#include <limits>

#include "resources/frame_constants.h"
#include "resources/texture_heap.h"
#include "run/pass_impl.h"
#include "tests/io/files.h"
#include "tests/run/run_frame.h"

#include "layout.h"

namespace wrinkle::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const Camera camera = Camera::look_at({10, -5, 2}, {0, 1, 0}, {0, 0, 1}, 0.9, 1.5);

/// What a call throws; empty where it throws nothing.
template <class Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const Error& error) { return error.what(); }
    return {};
}

template <class Call>
void expect_refusal(const Call& call, const std::string& about) {
    const std::string said = refusal(call);
    EXPECT_NE(said.find(about), std::string::npos) << "\"" << said << "\" does not name " << about;
}

/// Floats of a buffer on the device.
std::vector<float> floats(const cl::Buffer& buffer) {
    std::vector<float> values(buffer.getInfo<CL_MEM_SIZE>() / sizeof(float));
    device().queue.enqueueReadBuffer(buffer, CL_TRUE, 0, values.size() * sizeof(float), values.data());
    return values;
}

std::vector<float> narrowed(const std::vector<double>& numbers) { return {numbers.begin(), numbers.end()}; }

TexelData read(const TextureSource& source) { return texel_data({&source, 1}); }

TEST(Resources, ACameraIsWhatAPassUses) {
    const HostFrame frame = small_frame();
    Pass pass = evaluate(device(), data_scene("noise"), frame.frame);
    const std::vector<float> numbers = narrowed(camera_numbers(frame.frame.camera, frame.frame.size));
    EXPECT_EQ(numbers.size(), 76u);
    EXPECT_EQ(numbers, floats(pass.impl().frame));
}

TEST(Resources, ADecalIsWhatAPassUses) {
    const HostFrame frame = small_frame();
    const Projector row{.center = {1, 2, 0.5}, .half_size = {0.5, 0.25, 1}, .scale = 3, .object = 7};
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].scale = 0.5;
    scene.layers[0].bump = DecalsLayer{.textures = {{.file = data_folder / "textures/seal_height.png"}},
                                       .rows = std::make_shared<const std::vector<Projector>>(1, row)};
    Pass pass = evaluate(device(), scene, frame.frame);
    const std::vector<double> numbers =
        projector_numbers(row, {.texture = 0, .height = true}, eye_of(frame.frame.camera), 0.5);
    ASSERT_EQ(numbers.size(), 32u);
    const FrameConstants used = frame_constants(pass.impl().plan, {scene, {}}, frame.frame.camera, frame.frame.size);
    const auto* expected = reinterpret_cast<const double*>(used.projectors.data());
    EXPECT_EQ(numbers, std::vector<double>(expected, expected + 32));
}

TEST(Resources, TheEyeIsWhereTheCameraStands) {
    const Vec3 eye = eye_of(camera);
    EXPECT_NEAR(eye[0], 10, 1e-12);
    EXPECT_NEAR(eye[1], -5, 1e-12);
    EXPECT_NEAR(eye[2], 2, 1e-12);
}

TEST(Resources, AProjectorKnowsWhomItIsMeantFor) {
    const std::size_t mask = offsetof(wr_projector, mask) / sizeof(double);
    const std::vector<double> by_hash = projector_numbers({.cryptomatte = "#12345678"}, {}, {});
    EXPECT_EQ(by_hash[mask], 2);
    EXPECT_EQ(by_hash[mask + 1], 0x1234);
    EXPECT_EQ(by_hash[mask + 2], 0x5678);
    EXPECT_EQ(projector_numbers({.object = 7}, {}, {})[mask + 1], 7);
    EXPECT_EQ(projector_numbers({}, {}, {})[mask], 0);
}

/// Three channels that differ everywhere, in a file and in memory.
struct Pixels3 {
    TempFolder folder;
    std::vector<float> texels;

    Pixels3() {
        const auto pixel = [](int c, int x, int y) { return static_cast<float>((7 * c + 3 * x + 5 * y) % 11) / 11; };
        write_exr(folder / "map.exr", 6, 4, {"R", "G", "B"}, pixel);
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 6; ++x)
                for (int c = 0; c < 3; ++c) texels.push_back(pixel(c, x, y));
    }
};

TEST(Resources, MemoryIsReadAsAFileIs) {
    const Pixels3 pixels;
    for (const Content content : {Content::height, Content::normal, Content::slope, Content::object_normal})
        for (const Wrap wrap : {Wrap::repeat, Wrap::clamp}) {
            ImageSource file{.use = {.file = pixels.folder / "map.exr", .content = content, .wrap = wrap}};
            file.store = content == Content::object_normal ? TexelStore::vectors : TexelStore::slopes;
            ImageSource memory = file;
            memory.use.file.clear();
            memory.memory = ImageInMemory{6, 4, 3, pixels.texels};
            const TexelData wanted = read(file), found = read(memory);
            EXPECT_EQ(found.texels, wanted.texels);
            EXPECT_EQ(found.textures, wanted.textures);
            const TexelKind kind = content == Content::object_normal ? TexelKind::vector : TexelKind::slope;
            EXPECT_EQ(wanted.texels, load_textures({{.use = file.use, .kind = kind}}).texels);
        }
}

TEST(Resources, HeightsLieAsDocumented) {
    const std::vector<float> heights{1, 2, 3, 4, 5, 6, 7, 8};  // two rows of four, the upper one first
    const TexelData data = read(ImageSource{.memory = ImageInMemory{4, 2, 1, heights}, .store = TexelStore::values});
    ASSERT_EQ(data.textures.size(), static_cast<std::size_t>(WR_TEXTURE_WORDS));
    EXPECT_EQ(data.textures[WR_TEXTURE_WIDTH], 4u);
    EXPECT_EQ(data.textures[WR_TEXTURE_HEIGHT], 2u);
    EXPECT_EQ(data.textures[WR_TEXTURE_LEVELS], 3u);
    const std::uint32_t* place = &data.textures[WR_TEXTURE_OFFSETS];
    const auto texel = [&](int level, int x, int y, int width) {
        return data.texels.at(place[level] + static_cast<std::size_t>((y + 1) * (width + 2) + x + 1));
    };
    EXPECT_EQ(texel(0, 0, 0, 4), 5);
    EXPECT_EQ(texel(0, 3, 1, 4), 4);
    EXPECT_EQ(texel(0, -1, 0, 4), 8);
    EXPECT_EQ(texel(0, 0, 2, 4), 5);
    EXPECT_EQ(texel(1, 1, 0, 2), 5.5f);
    EXPECT_EQ(texel(2, 0, 0, 1), 4.5f);
    EXPECT_EQ(data.texels.size(), 4u * 6 + 4 * 3 + 3 * 3 + 4);
}

TEST(Resources, NothingIsLeftOutOfNothing) {
    EXPECT_TRUE(texel_data({}).textures.empty());
    EXPECT_EQ(texel_data({}).texels.size(), 4u);
}

TEST(Resources, BadImagesAreRefusedByNumber) {
    const std::vector<float> good(24, 0.5f);
    std::vector<float> bad = good;
    bad[9] = kNan;
    const auto two = [&](const ImageSource& second) {
        const ImageSource first{.memory = ImageInMemory{6, 4, 1, good}};
        return [=] { texel_data(std::vector<TextureSource>{first, second}); };
    };
    expect_refusal(two({.memory = ImageInMemory{7, 4, 1, good}}), "texture source 1: the image has 24 numbers; 7 x 4");
    expect_refusal(two({.memory = ImageInMemory{6, 0, 1, good}}), "texture source 1: the image has 6 x 0 pixels");
    expect_refusal(two({.memory = ImageInMemory{6, 4, 1, bad}}), "pixel (3, 1) from the top left is NaN");
    expect_refusal(two({.use = {.file = "missing.png"}}), "missing.png");
    expect_refusal(two({.memory = ImageInMemory{6, 4, 1, good}, .region = {0.5, 0, 0.5, 1}}), "the region");
    expect_refusal(two({.memory = ImageInMemory{6, 4, 1, good}, .store = TexelStore::vectors}), "object-space normals");
    expect_refusal(two({.use = {.content = Content::normal}, .memory = ImageInMemory{24, 1, 1, good}}),
                   "a normal map needs 3");
}

TEST(Resources, AnUnknownVolumeIsRefused) {
    expect_refusal([] { read(VolumeSource{.file = "missing.vdb"}); }, "texture source 0: missing.vdb");
    expect_refusal([] { read(VolumeSource{.file = data_folder / "textures/seal_height.png"}); }, "seal_height.png");
}

TEST(Resources, BadCamerasAndProjectorsAreRefused) {
    expect_refusal([] { camera_numbers(camera, {0, 5}); }, "0 x 5");
    EXPECT_NE(refusal([] { camera_numbers({}, {4, 5}); }), "");  // singular
    Camera broken = camera;
    broken.proj[1][2] = kNan;
    expect_refusal([&] { camera_numbers(broken, {4, 5}); }, "proj holds nan in row 2, column 3");
    broken = camera;
    broken.view[0][0] = kNan;
    expect_refusal([&] { eye_of(broken); }, "view holds nan in row 1, column 1");
    expect_refusal([] { projector_numbers({.center = {0, kNan, 0}}, {}, {}); }, "center holds nan");
    expect_refusal([] { projector_numbers({}, {}, {}, kNan); }, "scale holds nan");
    expect_refusal([] { projector_numbers({.axis_x = {0, 1, 0}}, {}, {}); }, "axis_x and axis_y");
}

}  // namespace
}  // namespace wrinkle::test
