#include "tools/pixel_points.h"

#include "tests/io/files.h"
#include "tests/run/area_frames.h"

namespace wrinkle::test {
namespace {

constexpr double kRepeats = 0.32;  // of the texture, a metre of the ground

PixelPoints::Planes planes_of(const HostFrame& frame) {
    PixelPoints::Planes planes;
    for (const auto& [name, pixels] : frame.pixels) planes[name] = pixels;
    return planes;
}

/// The ground with texture coordinates along its x and y.
HostFrame textured_ground() {
    HostFrame frame = ground(kSize);
    const PinholeRays rays = pinhole_rays(frame.frame.camera, kSize).value();
    auto &u = frame.add("uv.u"), &v = frame.add("uv.v");
    for (std::size_t i = 0; i < frame.count(); ++i) {
        const double x = static_cast<double>(i % kSize.width) + 0.5, y = static_cast<double>(i / kSize.width) + 0.5;
        const double depth = frame.pixels["depth"][i];
        u[i] = static_cast<float>(kRepeats * (rays.eye[0] + depth * (rays.d0[0] + x * rays.dx[0] + y * rays.dy[0])));
        v[i] = static_cast<float>(kRepeats * (rays.eye[1] + depth * (rays.d0[1] + x * rays.dx[1] + y * rays.dy[1])));
    }
    return frame;
}

struct Written {
    std::map<std::string, std::vector<float>> points;
    std::map<std::string, float*> into;

    explicit Written(const HostFrame& frame) {
        for (const auto& [name, pixels] : frame.pixels)
            into[name] = (points[name] = std::vector<float>(kPointsOfPixel)).data();
    }
};

TEST(PixelPoints, LieOnTheSurfaceWhereTheirCameraSeesThem) {
    const HostFrame frame = textured_ground();
    const PixelPoints::Planes planes = planes_of(frame);
    const PixelPoints points(frame.frame, planes);
    Written out(frame);
    int written = 0;
    for (const std::uint32_t y : {7u, 10u, 15u})
        for (const std::uint32_t x : {0u, 11u, 23u}) {
            if (!points.write(x, y, out.into)) continue;
            ++written;
            const Size size{kPointsAlong, kPointsAlong};
            const Camera camera = points.camera(x, y);
            const PinholeRays rays = pinhole_rays(camera, size).value();
            for (std::size_t i = 0; i < kPointsOfPixel; i += 37) {
                const double px = static_cast<double>(i % kPointsAlong) + 0.5,
                             py = static_cast<double>(i / kPointsAlong) + 0.5, depth = out.points["depth"][i];
                Vec3 p{};
                for (std::size_t k = 0; k < 3; ++k)
                    p[k] = rays.eye[k] + depth * (rays.d0[k] + px * rays.dx[k] + py * rays.dy[k]);
                EXPECT_NEAR(p[2], 0, 1e-5 * depth) << x << ", " << y << ": " << i;
                EXPECT_NEAR(out.points["uv.u"][i], kRepeats * p[0], 2e-4 * depth);
                EXPECT_NEAR(out.points["uv.v"][i], kRepeats * p[1], 2e-4 * depth);
                const auto seen = project(frame.frame.camera, kSize, p);
                ASSERT_TRUE(seen);
                EXPECT_NEAR((*seen)[0], x + px / kPointsAlong, 1e-4);
                EXPECT_NEAR((*seen)[1], y + py / kPointsAlong, 1e-4);
            }
        }
    EXPECT_GE(written, 6);
}

TEST(PixelPoints, AreNotGuessedWhereNothingContinuesThem) {
    HostFrame frame = textured_ground();
    constexpr std::uint32_t x = 11, y = 12;
    const std::size_t pixel = std::size_t{y} * kSize.width + x;
    Written out(frame);
    {
        const PixelPoints::Planes planes = planes_of(frame);
        EXPECT_TRUE(PixelPoints(frame.frame, planes).write(x, y, out.into));
    }
    const float u = frame.pixels["uv.u"][pixel];
    frame.pixels["uv.u"][pixel] += 7;  // a seam on all sides
    {
        const PixelPoints::Planes planes = planes_of(frame);
        EXPECT_FALSE(PixelPoints(frame.frame, planes).write(x, y, out.into));
    }
    frame.pixels["uv.u"][pixel] = u;
    frame.pixels["depth"][pixel] = 1e10f;
    const PixelPoints::Planes planes = planes_of(frame);
    EXPECT_FALSE(PixelPoints(frame.frame, planes).write(x, y, out.into));
    EXPECT_FALSE(PixelPoints(frame.frame, planes).normal(x, y));
}

TEST(PixelPoints, NeedASingleEye) {
    HostFrame frame = ground(kSize);
    frame.frame.camera = orthographic_camera();
    const PixelPoints::Planes planes = planes_of(frame);
    expect_mentions(error_of([&] { PixelPoints(frame.frame, planes); }), {"pinhole"});
}

}  // namespace
}  // namespace wrinkle::test
