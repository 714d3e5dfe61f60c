#pragma once

#include <cmath>

#include "io/metadata.h"
#include "tests/io/files.h"
#include "wrinkle/camera.h"

/// Frames that a known camera sees, for the tests of cameras.
namespace wrinkle::test {

inline constexpr Size size{96, 54};
inline constexpr double aspect = 96.0 / 54.0;

inline Camera true_camera() { return Camera::look_at({1.5, -7.5, 2.6}, {0, 0, 0.8}, {0, 0, 1}, 0.6, aspect); }

/// Planar depth of a wavy surface at a pixel; the first columns are background.
inline double depth_at(int x, int y) { return x < 5 ? 1e10 : 6 + std::sin(0.2 * x) + std::cos(0.3 * y); }

enum class Space { world, camera };

/// Writes a frame seen by true_camera(): positions, depth, and the attributes of `header`.
inline void write_frame(const std::filesystem::path& file, const Metadata& header, std::vector<std::string> names,
                        bool ray = false, Space space = Space::world) {
    const auto camera = true_camera();
    const auto rays = *pinhole_rays(camera, size);
    auto spec = make_spec(96, 54, std::move(names));
    for (const auto& name : header.names()) {
        const auto matrix = *header.matrix(name);
        float values[16];
        for (std::size_t i = 0; i < 16; ++i) values[i] = static_cast<float>(matrix[i / 4][i % 4]);
        spec.attribute(name, OIIO::TypeMatrix44, values);
    }
    const auto pixel = [&](int c, int x, int y) -> float {
        const double z = depth_at(x, y);
        Vec3 d{}, p{};
        for (std::size_t i = 0; i < 3; ++i) d[i] = rays.d0[i] + (x + 0.5) * rays.dx[i] + (y + 0.5) * rays.dy[i];
        if (c >= 3) return static_cast<float>(ray ? z * std::hypot(d[0], d[1], d[2]) : z);
        if (z > 1e9) return 0;
        for (std::size_t i = 0; i < 3; ++i) p[i] = rays.eye[i] + z * d[i];
        if (space == Space::world) return static_cast<float>(p[static_cast<std::size_t>(c)]);
        const auto& row = camera.view[static_cast<std::size_t>(c)];
        const double view = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        return static_cast<float>(c == 2 ? -view : view);  // left-handed, z forward
    };
    write_image(file, {{spec, pixel}});
}

inline const std::vector<std::string> plain_names{"position.x", "position.y", "position.z", "depth"};
inline const std::vector<std::string> pbrt_names{"P.X", "P.Y", "P.Z", "w", "Ns.X"};

inline Mat4 transposed(const Mat4& m) {
    Mat4 t{};
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t j = 0; j < 4; ++j) t[i][j] = m[j][i];
    return t;
}

/// The matrix from world space to the EXR standard's camera space, which is left-handed. Acts on column vectors.
inline Mat4 world_to_camera() {
    return multiply({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, 1}}}, true_camera().view);
}

/// The matrix from world space to normalised device coordinates with (0, 0) at the top left. Acts on column vectors.
inline Mat4 world_to_ndc() {
    const Mat4 window{{{0.5, 0, 0, 0.5}, {0, -0.5, 0, 0.5}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    return multiply(window, multiply(true_camera().proj, true_camera().view));
}

/// Expects that `camera` has the eye and the rays of true_camera().
inline void expect_same(const Camera& camera, double tolerance = 1e-4) {
    const auto found = pinhole_rays(camera, size), expected = pinhole_rays(true_camera(), size);
    ASSERT_TRUE(found);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(found->eye[i], expected->eye[i], tolerance);
        EXPECT_NEAR(found->d0[i], expected->d0[i], tolerance);
        EXPECT_NEAR(found->dx[i], expected->dx[i], tolerance);
        EXPECT_NEAR(found->dy[i], expected->dy[i], tolerance);
    }
}

}  // namespace wrinkle::test
