#include "io/header_camera.h"
#include "tests/io/camera_frames.h"

namespace wrinkle {
namespace {

using namespace test;

TEST(ClipCamera, ComesBackFromItsProduct) {
    for (const double skew : {0.0, 0.1}) {
        auto camera = true_camera();
        camera.proj[0][2] = 0.3, camera.proj[1][2] = -0.2, camera.proj[1][0] = skew;
        const auto found = io::camera_of_clip(multiply(camera.proj, camera.view));
        ASSERT_TRUE(found);
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                EXPECT_NEAR(found->view[i][j], camera.view[i][j], 1e-12);
                if (i != 2) { EXPECT_NEAR(found->proj[i][j], camera.proj[i][j], 1e-12); }
            }
    }
    Camera parallel = true_camera();
    parallel.proj = {{{0.2, 0, 0, 0.1}, {0, 0.3, 0, -0.1}, {0, 0, -0.1, 0}, {0, 0, 0, 1}}};
    const auto found = io::camera_of_clip(multiply(parallel.proj, parallel.view));
    ASSERT_TRUE(found);
    const Vec3 point{0.3, 0.2, 0.9};
    EXPECT_NEAR((*project(*found, size, point))[0], (*project(parallel, size, point))[0], 1e-9);
    EXPECT_NEAR((*project(*found, size, point))[1], (*project(parallel, size, point))[1], 1e-9);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(found->view[2][j], parallel.view[2][j], 1e-12);
    EXPECT_FALSE(io::camera_of_clip(Mat4{}));
}

}  // namespace
}  // namespace wrinkle
