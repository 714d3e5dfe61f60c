// Depth buffers of every kind of projection, against the projection itself in long double.
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

using reference::CameraRays;

struct Buffer {
    const char* what;
    Camera camera;
    DeviceDepth kind;
    double far;  ///< what the buffer was cleared to
};

Camera with_depth(Camera camera, double a, double b) {
    camera.proj[2] = {0, 0, a, b};
    return camera;
}

/// Near 0.1 m, far 1000 m.
const std::vector<Buffer>& buffers() {
    constexpr double near = 0.1, far = 1000, deep = far - near;
    static const std::vector<Buffer> all{
        {"0 to 1", with_depth(test_camera(), -far / deep, -far * near / deep), DeviceDepth::zero_to_one, 1},
        {"reversed", with_depth(test_camera(), near / deep, far * near / deep), DeviceDepth::zero_to_one, 0},
        {"infinite", with_depth(test_camera(), -1, -near), DeviceDepth::zero_to_one, 1},
        {"infinite, reversed", with_depth(test_camera(), 0, near), DeviceDepth::zero_to_one, 0},
        {"OpenGL's", with_depth(test_camera(), -(far + near) / deep, -2 * far * near / deep),
         DeviceDepth::minus_one_to_one, 1},
        {"parallel", with_depth(orthographic_camera(), -1 / deep, -near / deep), DeviceDepth::zero_to_one, 1},
        {"parallel, reversed", with_depth(orthographic_camera(), 1 / deep, far / deep), DeviceDepth::zero_to_one, 0},
        {"parallel, OpenGL's", with_depth(orthographic_camera(), -2 / deep, -(far + near) / deep),
         DeviceDepth::minus_one_to_one, 1},
    };
    return all;
}

/// What the buffer holds of a view depth, and back.
long double device_of(const Buffer& buffer, long double depth) {
    const auto& p = buffer.camera.proj;
    const long double d = (p[2][2] * -depth + p[2][3]) / (p[3][2] * -depth + p[3][3]);
    return buffer.kind == DeviceDepth::minus_one_to_one ? (d + 1) / 2 : d;
}
long double view_of(const Buffer& buffer, long double device) {
    const auto& p = buffer.camera.proj;
    const long double d = buffer.kind == DeviceDepth::minus_one_to_one ? 2 * device - 1 : device;
    return (p[2][3] - d * p[3][3]) / (p[2][2] - d * p[3][2]);
}

/// The buffer's numbers, as floats, are taken as exact: what floats of a buffer lose is the renderer's choice.
TEST(DeviceDepth, BecomesPositions) {
    const V slanted = normalize(V{0.1, -0.2, 1});
    for (const Buffer& buffer : buffers()) {
        HostFrame truth(plane_frame(buffer.camera, {61, 19}, slanted), buffer.camera);
        for (const char* axis : {"position.x", "position.y", "position.z", "uv.u", "uv.v"}) truth.remove(axis);
        HostFrame frame = truth;
        frame.frame.device_depth = buffer.kind;
        double rounding = 0;
        for (std::size_t i = 0; i < frame.count(); ++i) {
            float& depth = truth.pixels.at("depth")[i];
            const auto device = static_cast<float>(device_of(buffer, depth));
            const auto back = static_cast<float>(view_of(buffer, device));
            rounding = std::max(rounding, std::abs(back / static_cast<double>(depth) - 1));
            frame.pixels.at("depth")[i] = device, depth = back;
            if (i % 17 == 0) frame.pixels.at("depth")[i] = static_cast<float>(buffer.far), depth = INFINITY;
        }
        Scene scene;
        scene.layers.resize(1);
        scene.layers[0].name = "noise", scene.layers[0].bump = NoiseLayer{.frequency = 1}, scene.layers[0].scale = 0.1;
        scene.output = {.dp_dx = true, .dp_dy = true, .marked = true};
        const Pixels got = evaluate_on(frame, scene, {.lanes = 16}), want = evaluate_on(truth, scene, {.lanes = 16});
        EXPECT_EQ(got.at("marked"), want.at("marked")) << buffer.what;
        double worst = 0;
        for (std::size_t i = 0; i < frame.count(); ++i)
            for (const char* step : {"dp_dx", "dp_dy"}) {
                const V a = vec_at(got, step, i), b = vec_at(want, step, i);
                ASSERT_TRUE(std::isfinite(length(a)) && std::isfinite(length(b))) << buffer.what << ' ' << i;
                if (length(b) > 0) worst = std::max(worst, length(a - b) / length(b));
            }
        double degrees = 0;  // of bumps, which depend on the positions
        for (std::size_t i = 0; i < frame.count(); ++i) {
            const double off = angle_degrees(vec_at(got, "normal", i), vec_at(want, "normal", i));
            ASSERT_TRUE(std::isfinite(off)) << buffer.what << ' ' << i;
            degrees = std::max(degrees, off);
        }
        fmt::print(
            "{}: steps off by {:.2g}, normals by {:.2g} degrees; floats of the buffer cost {:.2g} of the depth\n",
            buffer.what, worst, degrees, rounding);
        EXPECT_LE(worst, 6e-7) << buffer.what;
        EXPECT_LE(degrees, 3e-3) << buffer.what;  // fine bumps turn that much within an ulp of the depth
    }
}

TEST(DeviceDepth, NeedsAProjectionThatTells) {
    HostFrame frame(plane_frame(test_camera(), {8, 8}, {0, 0, 1}), test_camera());
    frame.frame.device_depth = DeviceDepth::zero_to_one;
    const auto refused = [&](const Camera& camera) {
        frame.frame.camera = camera;
        try {
            screen_derivatives(device(), frame.frame, {.lanes = 1});
        } catch (const Error& error) { return std::string(error.what()); }
        return std::string("accepted");
    };
    EXPECT_NE(refused(with_depth(test_camera(), -1, 0)).find("found 0, 0, -1, 0"), std::string::npos);
    EXPECT_NE(refused(tilted_camera()).find("projection"), std::string::npos);
    Camera oblique = test_camera();
    oblique.proj[2][0] = 0.1;
    EXPECT_NE(refused(oblique).find("0, 0, a, b"), std::string::npos);
    Camera left_handed = test_camera();
    left_handed.proj[3] = {0, 0, 1, 0};
    EXPECT_NE(refused(left_handed).find("fourth row is 0, 0, -1, 0"), std::string::npos);
    EXPECT_NE(refused(left_handed).find("found 0, 0, 1, 0"), std::string::npos);
    frame.frame.device_depth = DeviceDepth::minus_one_to_one;
    EXPECT_NE(refused(with_depth(test_camera(), 0, 0.1)).find("reversed"), std::string::npos);
    frame.frame.ray_depth = true;
    EXPECT_NE(refused(test_camera()).find("not both"), std::string::npos);
}

}  // namespace
}  // namespace wrinkle::test
