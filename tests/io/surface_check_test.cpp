// Passes of one frame that do not fit together: each looks as any other does, and bumps on it would be wrong.
#include "io/surface_check.h"

#include <array>
#include <cmath>
#include <map>

#include "io/camera_file.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;
using Planes = std::map<std::string, std::vector<float>>;
using Normal = std::array<double, 3>;

std::string data_file(const std::string& name) { return WRINKLE_SOURCE_DIR "/data/gbuffer/" + name; }

/// The sample frame's planes by the channels that a file with plain names has.
class SurfaceCheck : public testing::Test {
protected:
    SurfaceCheck() {
        const GBufferReader reader(data_file("small.exr"));
        size_ = reader.size();
        const std::map<std::string, std::string> named{
            {"N.X", "normal.x"},   {"N.Y", "normal.y"},   {"N.Z", "normal.z"}, {"P.X", "position.x"},
            {"P.Y", "position.y"}, {"P.Z", "position.z"}, {"Z", "depth"}};
        for (const auto& [channel, plane] : named) {
            auto& values = planes_[channel];
            values.resize(std::size_t{size_.width} * size_.height);
            float* const out = values.data();
            reader.read_rows(0, size_.height, {&plane, 1}, {&out, 1});
        }
    }

    std::vector<std::string> doubts(const Planes& planes, bool* depth_fits = nullptr) const {
        std::vector<std::string> names;
        std::vector<const std::vector<float>*> values;
        for (const auto& [name, of_channel] : planes) names.push_back(name), values.push_back(&of_channel);
        const auto at = [&](int channel, int x, int y) {
            return (*values[static_cast<std::size_t>(channel)])[static_cast<std::size_t>(y) * size_.width +
                                                                static_cast<std::size_t>(x)];
        };
        write_exr(folder_ / "frame.exr", static_cast<int>(size_.width), static_cast<int>(size_.height), names, at);
        const GBufferReader reader(folder_ / "frame.exr");
        CameraSource source;
        source.file = data_file("small.camera.json");
        const FrameCamera camera = read_frame_camera(source, reader);
        if (depth_fits != nullptr) *depth_fits = camera.depth_fits;
        return camera.doubts;
    }

    template <class Turn>
    Planes with_normals(const Turn& turn) const {
        Planes planes = planes_;
        for (std::size_t i = 0; i < planes["Z"].size(); ++i) {
            const Normal n = turn(Normal{planes_.at("N.X")[i], planes_.at("N.Y")[i], planes_.at("N.Z")[i]});
            planes["N.X"][i] = static_cast<float>(n[0]);
            planes["N.Y"][i] = static_cast<float>(n[1]);
            planes["N.Z"][i] = static_cast<float>(n[2]);
        }
        return planes;
    }

    template <class Change>
    Planes with_depth(const Change& change, bool positions) const {
        Planes planes = planes_;
        for (float& depth : planes["Z"]) depth = change(depth);
        if (!positions)
            for (const char* axis : {"P.X", "P.Y", "P.Z"}) planes.erase(axis);
        return planes;
    }

    static void expect_one(const std::vector<std::string>& doubts, const std::vector<std::string>& parts) {
        ASSERT_EQ(doubts.size(), 1u);
        expect_mentions(doubts.front(), parts);
    }

    TempFolder folder_;
    Size size_;
    Planes planes_;
};

TEST_F(SurfaceCheck, FramesOfRenderersFit) {
    EXPECT_TRUE(doubts(planes_).empty());
    EXPECT_TRUE(doubts(with_depth([](float z) { return z; }, false)).empty());
    const auto bumped = with_normals([](Normal n) {  // by up to 25 degrees, as a normal pass with bump in it is
        const double by = 0.45 * std::sin(1e4 * n[0]);
        return Normal{n[0] + by * n[1], n[1] - by * n[0], n[2] + by * n[0]};
    });
    EXPECT_TRUE(doubts(bumped).empty());
    for (const char* frame : {"courtyard", "cycles_torus", "cycles_ground"}) {
        const GBufferReader reader(data_file(std::string(frame) + ".exr"));
        CameraSource source;
        source.file = data_file(std::string(frame) + ".camera.json");
        EXPECT_TRUE(read_frame_camera(source, reader).doubts.empty()) << frame;
    }
}

TEST_F(SurfaceCheck, NormalsInAnotherSpaceAreTold) {
    const GBufferReader reader(data_file("small.exr"));
    CameraSource source;
    source.file = data_file("small.camera.json");
    const Mat4 view = read_frame_camera(source, reader).camera.view;
    const auto seen = [&](Normal n, double z) {
        Normal out{};
        for (std::size_t k = 0; k < 3; ++k) out[k] = view[k][0] * n[0] + view[k][1] * n[1] + view[k][2] * n[2];
        out[2] *= z;
        return out;
    };
    expect_one(doubts(with_normals([&](Normal n) { return seen(n, 1); })),
               {"the normals (N.X) do not fit", "the position pass", "normals = \"camera\""});
    expect_one(doubts(with_normals([&](Normal n) { return seen(n, -1); })), {"z grows away from the viewer"});
    expect_one(doubts(with_normals([](Normal n) { return Normal{n[0], n[2], -n[1]}; })), {"y up"});
    expect_one(doubts(with_normals([](Normal n) { return Normal{-n[0], -n[1], -n[2]}; })), {"inside out"});
}

/// A sphere that a parallel camera sees from above.
TEST(SurfaceCheckOfParallelCameras, NormalsInAnotherSpaceAreTold) {
    const TempFolder folder;
    constexpr int size = 96;
    CameraSource source;
    source.inline_camera = Camera{{{{1, 0, 0, 0}, {0, 0, 1, 0}, {0, -1, 0, -8}, {0, 0, 0, 1}}},
                                  {{{0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, -0.1, 0}, {0, 0, 0, 1}}}};
    for (const bool in_camera_space : {false, true}) {
        const auto pixel = [&](int c, int x, int y) {
            const double u = 2 * ((2 * x + 1.0) / size - 1), v = 2 * (1 - (2 * y + 1.0) / size);
            const double w = std::sqrt(std::max(1.9 * 1.9 - u * u - v * v, 0.0)), length = 1.9;
            if (w < 0.4) return c == 3 ? 1e10f : 0.0f;
            // The view's axes are x, z and -y: it looks along y.
            const double seen[3] = {u / length, v / length, w / length}, world[3] = {seen[0], -seen[2], seen[1]};
            if (c == 3) return static_cast<float>(8 - w);
            return static_cast<float>(in_camera_space ? seen[c] : world[c]);
        };
        write_exr(folder / "p.exr", size, size, {"N.X", "N.Y", "N.Z", "Z"}, pixel);
        const GBufferReader reader(folder / "p.exr");
        const std::vector<std::string> doubts = read_frame_camera(source, reader).doubts;
        ASSERT_EQ(doubts.size(), in_camera_space ? 1u : 0u);
        if (in_camera_space) expect_mentions(doubts.front(), {"normals = \"camera\""});
    }
}

TEST_F(SurfaceCheck, DepthThatIsNoDistanceIsTold) {
    bool fits = true;
    EXPECT_TRUE(doubts(planes_, &fits).empty());
    EXPECT_TRUE(fits);
    for (const float factor : {100.0f, -1.0f}) {
        expect_one(doubts(with_depth([&](float z) { return z < 1e9f ? factor * z : z; }, true), &fits),
                   {"depth (Z) does not fit the positions", "Positions are used"});
        EXPECT_FALSE(fits);
    }
    expect_one(doubts(with_depth([](float z) { return z < 1e9f ? z / 1000 : 0; }, true), &fits), {"is off by"});
    expect_one(doubts(with_depth([](float z) { return z < 1e9f ? z / 1000 : 1; }, false)), {"between 0 and 1"});
    expect_one(doubts(with_depth([](float z) { return -z; }, false)), {"depth (Z) is negative for 100%"});
}

TEST_F(SurfaceCheck, TheSurfaceIsThatOfDepthWithoutPositions) {
    auto planes = with_normals([](Normal n) { return Normal{n[0], n[2], -n[1]}; });
    for (const char* axis : {"P.X", "P.Y", "P.Z"}) planes.erase(axis);
    expect_one(doubts(planes), {"depth, seen by this camera", "y up"});
}

}  // namespace
}  // namespace wrinkle
