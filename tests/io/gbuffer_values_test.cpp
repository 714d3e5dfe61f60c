// What the numbers of a G-buffer become when they are read: integers, packed normals, turned texture coordinates.
#include <bit>
#include <cmath>

#include "tests/io/read_planes.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

TEST(GBufferValues, WholeNumberChannelsKeepTheirValue) {
    TempFolder folder;
    auto spec = make_spec(4, 4, {"N.X", "N.Y", "N.Z", "object.I"});
    spec.channelformats = {OIIO::TypeFloat, OIIO::TypeFloat, OIIO::TypeFloat, OIIO::TypeUInt32};
    // OpenImageIO writes UINT channels as shares of 2^32 - 1.
    write_image(
        folder / "id.exr",
        {{spec, [](int c, int x, int y) { return c < 3 ? numbered(c, x, y) : 0x1p-20f * static_cast<float>(x); }}});
    const auto values = read(GBufferReader(folder / "id.exr"), 0, 4, {"object", "normal.x"});
    EXPECT_NEAR(values[0][3], 3 * 4096, 1);
    EXPECT_EQ(values[1][4 + 3], numbered(0, 3, 1));
}

/// A file of one channel of unsigned integers.
void write_integers(const std::filesystem::path& file, const std::string& channel, std::vector<std::uint32_t> row) {
    auto spec = make_spec(static_cast<int>(row.size()), 1, {channel}, OIIO::TypeUInt32);
    auto output = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(output->open(file.string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeUInt32, row.data()));
    ASSERT_TRUE(output->close());
}

TEST(GBufferValues, IntegersKeepAll32Bits) {
    TempFolder folder;
    const std::vector<std::uint32_t> numbers{0, 3, 16777216, 16777217, 4294967295u};
    write_integers(folder / "id.exr", "object", numbers);
    const GBufferReader reader(folder / "id.exr");
    EXPECT_EQ(reader.object_storage(), io::ObjectStorage::whole);
    EXPECT_EQ(reader.channel_type("object"), ChannelType::whole);
    const auto values = read(reader, 0, 1, {"object", "bits:object", "channel:object"});
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        EXPECT_EQ(values[0][i], io::object_label(numbers[i]));
        EXPECT_EQ(std::bit_cast<std::uint32_t>(values[1][i]), numbers[i]);
        EXPECT_EQ(values[2][i], static_cast<float>(numbers[i]));
    }
}

TEST(GBufferValues, ObjectNumbersThatAFilterHasAveraged) {
    TempFolder folder;
    write_exr(folder / "id.exr", 4, 2, {"si.I"}, [](int, int x, int) {
        return x == 0 ? 2.9999998f : x == 1 ? 2.5f : 7.0f;
    });
    EXPECT_EQ(read(GBufferReader(folder / "id.exr"), 0, 1, {"object"})[0], (std::vector<float>{3, 2.5f, 7, 7}));
}

TEST(GBufferValues, NormalsAreReadAsTheSceneSays) {
    TempFolder folder;
    const float n[3] = {0.6f, 0, 0.8f};
    GBufferSource source;
    write_exr(folder / "n.exr", 8, 8, {"N.X", "N.Y", "N.Z", "P.X", "P.Y", "P.Z"},
              [&](int c, int, int) { return c < 3 ? (n[c] + 1) / 2 : 1.0f; });
    const Names normal{"normal.x", "normal.y", "normal.z"};
    const auto at = [&](const GBufferReader& reader, std::size_t axis) { return read(reader, 0, 1, normal)[axis][0]; };
    EXPECT_TRUE(GBufferReader(folder / "n.exr").packed_normals()) << "whatever the writer";
    EXPECT_NEAR(at(GBufferReader(folder / "n.exr"), 0), 0.6, 1e-6);
    source.normals = NormalKind::sign;
    EXPECT_NEAR(at(GBufferReader(folder / "n.exr", source), 0), 0.8, 1e-6);
    write_exr(folder / "s.exr", 8, 8, {"N.X", "N.Y", "N.Z"}, [&](int c, int, int) { return n[c]; });
    EXPECT_NEAR(at(GBufferReader(folder / "s.exr"), 0), 0.6, 1e-6);
    source.normals = NormalKind::packed;
    EXPECT_NEAR(at(GBufferReader(folder / "s.exr", source), 0), 0.2, 1e-6);
    source.normals = NormalKind::camera;
    GBufferReader reader(folder / "s.exr", source);
    EXPECT_FALSE(reader.normals_are_in_world_space());
    const auto camera = Camera::look_at({0, -5, 0}, {0, 0, 0}, {0, 0, 1}, 1, 1);  // its z is the world's -y
    reader.turn_normals(camera.view);
    EXPECT_TRUE(reader.normals_are_in_world_space());
    EXPECT_NEAR(at(reader, 0), 0.6, 1e-6);
    EXPECT_NEAR(at(reader, 1), -0.8, 1e-6);
    EXPECT_NEAR(at(reader, 2), 0, 1e-6);
}

TEST(GBufferValues, TextureCoordinatesThatGrowDownwardsAreTurned) {
    TempFolder folder;
    write_exr(folder / "m.exr", 2, 2, {"uv.U", "uv.V", "dd.T", "duv_dx.U", "duv_dx.V", "dp_dv.X", "dp_dv.Y", "dp_dv.Z"},
              [](int c, int, int) { return c == 0 ? 0.25f : 0.125f; });
    const auto values = read(GBufferReader(folder / "m.exr"), 0, 1, {"uv.u", "uv.v", "duv_dx.v", "dp_dv.y"});
    EXPECT_EQ(values[1][0], 0.875f);
    EXPECT_EQ(values[2][0], -0.125f);
    EXPECT_EQ(values[3][0], -0.125f);
    GBufferSource source;
    source.v = VDirection::up;
    EXPECT_EQ(read(GBufferReader(folder / "m.exr", source), 0, 1, {"uv.v"})[0][0], 0.125f);
}

TEST(GBufferValues, UnrealPackedNormalsAreUnpacked) {
    TempFolder folder;
    const auto packed = [](int c, int x, int y) {
        const float n[3] = {std::sin(0.1f * static_cast<float>(x)), 0, std::cos(0.1f * static_cast<float>(x))};
        return y == 0 ? 0.0f : (n[c] + 1) / 2;
    };
    const auto names = Names{"FinalImageMovieRenderQueue_WorldNormal.R", "FinalImageMovieRenderQueue_WorldNormal.G",
                             "FinalImageMovieRenderQueue_WorldNormal.B"};
    write_exr(folder / "packed.exr", 60, 30, names, packed);
    const GBufferReader reader(folder / "packed.exr");
    EXPECT_TRUE(reader.packed_normals());
    const auto n = read(reader, 0, 2, {"normal.z", "normal.x", "normal.y"});
    EXPECT_EQ(n[0][20], 0.0f);  // background stays (0, 0, 0)
    EXPECT_NEAR(n[1][60 + 20], std::sin(2.0f), 1e-6);
    EXPECT_NEAR(n[0][60 + 20], std::cos(2.0f), 1e-6);

    write_exr(folder / "signed.exr", 60, 30, names,
              [&](int c, int x, int y) { return y == 0 ? 0.0f : 2 * packed(c, x, y) - 1; });
    EXPECT_FALSE(GBufferReader(folder / "signed.exr").packed_normals());
}

TEST(GBufferValues, PackedNormalsAreRecognisedBesideMuchBackground) {
    const TempFolder folder;
    constexpr int size = 64;
    for (const float background : {0.0f, 0.5f, 128.0f / 255, 1.0f}) {
        const auto pixel = [&](int c, int x, int y) {
            if (x < 2 * size / 3) return background;
            const double a = 0.1 * x, b = 0.02 * y + 0.1;
            const double n[3] = {std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)};
            return static_cast<float>((n[c] + 1) / 2);
        };
        write_exr(folder / "a.exr", size, size, {"N.X", "N.Y", "N.Z"}, pixel);
        const GBufferReader reader(folder / "a.exr");
        EXPECT_TRUE(reader.packed_normals()) << background;
        const std::vector<std::string> planes{"normal.x", "normal.y", "normal.z"};
        std::vector<float> n[3];
        std::vector<float*> out;
        for (auto& axis : n) axis.resize(size), out.push_back(axis.data());
        reader.read_rows(0, 1, planes, out);
        EXPECT_EQ(std::hypot(n[0][0], n[1][0], n[2][0]), 0) << background << ": no surface";
        EXPECT_NEAR(std::hypot(n[0][60], n[1][60], n[2][60]), 1, 1e-5);
    }
}

TEST(GBufferValues, DepthKindFollowsTheSceneFirst) {
    TempFolder folder;
    write_exr(folder / "m.exr", 4, 4, {"dd.T"});
    EXPECT_EQ(GBufferReader(folder / "m.exr").roles().depth, DepthKind::ray);
    EXPECT_EQ(GBufferReader(folder / "m.exr", {.file = {}, .roles = {}, .depth = DepthKind::planar}).roles().depth,
              DepthKind::planar);
}

TEST(GBufferValues, CryptomatteIdsComeThroughBitByBit) {
    TempFolder folder;
    auto spec = make_spec(2, 1, blender_channels);
    spec.attribute("cryptomatte/542cafa/name", "ViewLayer.CryptoObject");
    spec.attribute("cryptomatte/542cafa/manifest", R"({"Rock":"f9fa0452","Ground":"24950135"})");
    write_image(folder / "c.exr",
                {{spec, [](int c, int, int) { return c == 4 ? std::bit_cast<float>(0xf9fa0452u) : 0.5f; }}});
    const GBufferReader reader(folder / "c.exr");
    const auto values = read(reader, 0, 1, {"crypto.id0", "crypto.coverage0"});
    EXPECT_EQ(std::bit_cast<std::uint32_t>(values[0][1]), reader.cryptomatte().id("Rock"));
    EXPECT_EQ(values[1][1], 0.5f);
    EXPECT_EQ(reader.cryptomatte().names(), (Names{"Ground", "Rock"}));
    expect_mentions(error_of([&] { reader.cryptomatte().id("Rok"); }), {"nearest: \"Rock\"", "Ground"});

    write_exr(folder / "half.exr", 2, 1, blender_channels, numbered, OIIO::TypeHalf);
    expect_mentions(error_of([&] { read(GBufferReader(folder / "half.exr"), 0, 1, {"crypto.id0"}); }), {"16-bit"});
}

}  // namespace
}  // namespace wrinkle
