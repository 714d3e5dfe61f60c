#include "io/info.h"

#include <cmath>
#include <limits>

#include "tests/io/files.h"
#include "tools/readiness.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

Readiness use_of(const GBufferInfo& info, const std::string& use) {
    const std::vector<Readiness> uses = readiness(info);
    const auto found = std::ranges::find(uses, use, &Readiness::use);
    EXPECT_NE(found, uses.end()) << use;
    return *found;
}

const RoleStats& stats_of(const GBufferInfo& info, const std::string& role) {
    const auto found = std::ranges::find(info.stats, role, &RoleStats::role);
    EXPECT_NE(found, info.stats.end()) << role;
    return *found;
}

TEST(Info, CountsWhatCannotBeUsed) {
    TempFolder folder;
    const auto pixel = [](int c, int x, int y) -> float {
        if (c < 3)
            return y == 0             ? 0.0f
                   : x == 1 && y == 1 ? std::numeric_limits<float>::quiet_NaN()
                                      : (c == 2 ? -0.5f : 0.25f);
        return y == 0 ? 1e10f : x == 3 ? -1.0f : static_cast<float>(x + 1);
    };
    write_exr(folder / "f.exr", 10, 200, {"N.X", "N.Y", "N.Z", "Z"}, pixel);
    const auto info = gather_info({.file = folder / "f.exr", .roles = {}});
    EXPECT_EQ(info.size, (Size{10, 200}));
    EXPECT_EQ(info.channels.size(), 4u);
    const auto& normal = stats_of(info, "normal");
    EXPECT_EQ(normal.invalid, 11u);
    EXPECT_EQ(normal.min, -0.5);
    EXPECT_EQ(normal.max, 0.25);
    EXPECT_EQ(normal.channels, (Names{"N.X", "N.Y", "N.Z"}));
    const auto& depth = stats_of(info, "depth");
    EXPECT_EQ(depth.invalid, 10u + 199u);
    EXPECT_EQ(depth.min, 1);
    EXPECT_EQ(depth.max, 10);
    EXPECT_FALSE(info.camera);
    expect_mentions(info.camera_problem, {"no f.exr.camera.json", "the header has none", "without a position pass"});
}

TEST(Info, SaysWhatEachUseLacks) {
    TempFolder folder;
    write_exr(folder / "f.exr", 4, 4, {"N.X", "N.Y", "N.Z", "Z", "roughness"});
    write_text(
        folder / "f.exr.camera.json",
        R"({"view": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]], "proj": [[1,0,0,0],[0,1,0,0],[0,0,-1,-1],[0,0,-1,0]]})");
    const auto info = gather_info({.file = folder / "f.exr", .roles = {}});
    ASSERT_TRUE(info.camera) << info.camera_problem;
    expect_mentions(info.camera->origin, {"f.exr.camera.json"});
    EXPECT_FALSE(info.camera->residual);
    EXPECT_EQ(use_of(info, "normal_map").missing, Names{"uv"});
    EXPECT_EQ(use_of(info, "object_normal").missing, Names{"uv"});
    EXPECT_EQ(use_of(info, "normal_map with tangents = \"passes\"").missing,
              (Names{"uv", "tangent", "tangent_sign or bitangent"}));
    EXPECT_TRUE(use_of(info, "triplanar").missing.empty());
    EXPECT_EQ(use_of(info, "lighting").defaults, Names{"albedo"});
    EXPECT_EQ(use_of(info, "relight = \"ratio\"").missing, Names{"beauty"});
    EXPECT_EQ(use_of(info, "mask by object").missing, Names{"object"});

    write_exr(folder / "n.exr", 4, 4, {"R", "G", "B"});
    EXPECT_EQ(use_of(gather_info({.file = folder / "n.exr", .roles = {}}), "decal").missing,
              (Names{"normal", "depth or position", "camera"}));
}

TEST(Info, CryptomattesOfHalfFloatsAreNotReady) {
    TempFolder folder;
    write_exr(folder / "f.exr", 4, 4, {"CryptoObject00.R", "CryptoObject00.G", "CryptoObject00.B", "CryptoObject00.A"},
              numbered, OIIO::TypeHalf);
    const auto info = gather_info({.file = folder / "f.exr", .roles = {}});
    expect_mentions(info.cryptomatte_problem, {"16-bit", "render cryptomattes as 32-bit float"});
    const Names missing = use_of(info, "mask by cryptomatte").missing;
    EXPECT_NE(std::ranges::find(missing, "whole ids of 32 bits"), missing.end());
}

// What `run` refuses is not called ready.
TEST(Info, ACameraOfAnotherFrameIsNoCamera) {
    TempFolder folder;
    const std::filesystem::path data = std::filesystem::path(WRINKLE_SOURCE_DIR) / "data/gbuffer";
    CameraSource camera;
    camera.inline_camera = Camera::look_at({9, 9, 9}, {0, 0, 0}, {0, 0, 1}, 1, 1.5);
    const auto info = gather_info({.file = data / "small.exr", .roles = {}}, camera);
    expect_mentions(info.camera_problem, {"does not fit", "from = \"positions\" solves fits within"});
    for (const Readiness& use : readiness(info))
        EXPECT_TRUE(std::ranges::find(use.missing, "camera that fits the positions") != use.missing.end()) << use.use;
}

TEST(Info, LargeFramesAreMeasuredByRowsSpreadOverThem) {
    TempFolder folder;
    std::vector<std::string> names{"N.X", "N.Y", "N.Z", "Z", "id"};
    for (int i = 0; i < 60; ++i) names.push_back("extra" + std::to_string(i));
    const auto pixel = [](int c, int x, int) { return c == 4 ? (x % 4 == 0 ? 2.5f : 3.0f) : 1.0f; };
    write_exr(folder / "f.exr", 1024, 1024, names, pixel);
    const auto info = gather_info({.file = folder / "f.exr", .roles = {}});
    EXPECT_LT(info.measured, info.pixels());
    EXPECT_GT(info.measured, info.pixels() / 8);
    EXPECT_EQ(stats_of(info, "object").mixed, info.measured / 4);
    EXPECT_EQ(info.types.front(), ChannelType::single);
}

TEST(Info, CommittedBlenderFrame) {
    const std::filesystem::path file = std::filesystem::path(WRINKLE_SOURCE_DIR) / "data/gbuffer/small.exr";
    const auto info = gather_info({.file = file, .roles = {}});
    EXPECT_EQ(info.roles.writer, Writer::blender);
    EXPECT_EQ(info.roles.depth, DepthKind::planar);
    for (const char* kind : {"normal_map", "triplanar", "noise", "decal", "mask by object", "mask by cryptomatte"}) {
        EXPECT_TRUE(use_of(info, kind).missing.empty()) << kind;
    }
    EXPECT_EQ(stats_of(info, "position").invalid, 0u);
    EXPECT_FALSE(info.cryptomatte_names.empty());
    ASSERT_TRUE(info.camera) << info.camera_problem;
    ASSERT_TRUE(info.camera->residual);
    EXPECT_LT(info.camera->residual->median, 0.003);
    EXPECT_EQ(info.camera->depth, DepthKind::planar);
}

}  // namespace
}  // namespace wrinkle
