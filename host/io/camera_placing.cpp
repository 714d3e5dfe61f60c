#include "io/camera_placing.h"

#include <cmath>

namespace wrinkle::io {
namespace {

/// Half the picture's width and height at distance 1.
std::array<double, 2> half_sides(const CameraSource::LookAt& at, double width, double height) {
    if (at.fov_x > 0) return {std::tan(at.fov_x / 2), std::tan(at.fov_x / 2) * height / width};
    if (!at.lens) return {std::tan(at.fov_y / 2) * width / height, std::tan(at.fov_y / 2)};
    const Lens& lens = *at.lens;
    const bool horizontal = lens.fit == Lens::Fit::horizontal || (lens.fit == Lens::Fit::automatic && width >= height);
    // Automatic takes the sensor's width for the longer side, even if that is the height.
    const double sensor = lens.fit == Lens::Fit::vertical ? lens.sensor[1] : lens.sensor[0];
    const double half = sensor / (2 * lens.focal);
    if (horizontal) return {half, half * height / width};
    return {half * width / height, half};
}

}  // namespace

Camera camera_looking(const CameraSource::LookAt& at, Size display, double pixel_aspect) {
    const double width = display.width * pixel_aspect, height = display.height;
    const auto [x, y] = half_sides(at, width, height);
    Camera camera = Camera::look_at(at.eye, at.target, at.up, 2 * std::atan(y), x / y);
    const double longer = std::max(width, height);
    camera.proj[0][2] = 2 * at.shift[0] * longer / width;
    camera.proj[1][2] = 2 * at.shift[1] * longer / height;
    return camera;
}

Camera windowed(const Camera& camera, const FrameWindow& window, Size frame) {
    if (window.display == frame) return camera;
    const double sx = static_cast<double>(window.display.width) / frame.width;
    const double sy = static_cast<double>(window.display.height) / frame.height;
    const double tx = sx - 1 - 2.0 * window.x / frame.width, ty = 1 - sy + 2.0 * window.y / frame.height;
    Camera out = camera;
    for (std::size_t k = 0; k < 4; ++k) {
        out.proj[0][k] = sx * camera.proj[0][k] + tx * camera.proj[3][k];
        out.proj[1][k] = sy * camera.proj[1][k] + ty * camera.proj[3][k];
    }
    return out;
}

}  // namespace wrinkle::io
