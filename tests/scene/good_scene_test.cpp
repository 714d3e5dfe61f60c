#include "tests/scene/full_scene.h"
#include "tests/scene/scene_folder.h"

namespace wrinkle {
namespace {

using GoodScene = SceneFolder;

TEST_F(GoodScene, FrameAndCamera) {
    const Scene scene = load(full_scene);
    EXPECT_EQ(scene.file, folder_ / "courtyard.toml");
    EXPECT_EQ(scene.gbuffer.file, folder_ / "frame.exr");
    EXPECT_EQ(scene.gbuffer.roles,
              (std::map<std::string, std::string>{{"position", "ViewLayer.Position"}, {"uv", "ViewLayer.UV"}}));
    EXPECT_EQ(scene.gbuffer.geometry, Geometry::position);
    EXPECT_EQ(scene.gbuffer.depth, DepthKind::ray);
    EXPECT_TRUE(scene.camera.file.empty());
    EXPECT_FALSE(scene.camera.exr);
    EXPECT_FALSE(scene.camera.inline_camera);
    ASSERT_TRUE(scene.camera.look_at);
    EXPECT_EQ(scene.camera.look_at->eye, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene.camera.look_at->target, (Vec3{0, 0, 0.5}));
    EXPECT_EQ(scene.camera.look_at->up, (Vec3{0, 1, 0}));
    EXPECT_DOUBLE_EQ(scene.camera.look_at->fov_y, 45 * degree);
    EXPECT_EQ(scene.camera.max_residual, 2);
}

TEST_F(GoodScene, LightingAndOutput) {
    const Scene scene = load(full_scene);
    const Lighting& lighting = scene.lighting;
    EXPECT_EQ(lighting.relight, Relight::ratio);
    EXPECT_EQ(lighting.ambient, (Vec3{0.1, 0.2, 0.3}));
    EXPECT_EQ(lighting.albedo, (Vec3{0.4, 0.5, 0.6}));
    EXPECT_EQ(lighting.roughness, 0.25);
    EXPECT_EQ(lighting.f0, 0.05);
    EXPECT_EQ(lighting.max_ratio, 8);
    EXPECT_EQ(lighting.exposure, -1.5);
    ASSERT_EQ(lighting.lights.size(), 3u);
    EXPECT_EQ(lighting.lights[0].kind, LightKind::sun);
    EXPECT_EQ(lighting.lights[0].color, (Vec3{1, 0.5, 0.25}));
    EXPECT_EQ(lighting.lights[0].intensity, 3);
    EXPECT_NE(lighting.lights[0].location.find(":"), std::string::npos) << lighting.lights[0].location;
    EXPECT_EQ(lighting.lights[2].diffuse, "lamp_diffuse");
    EXPECT_EQ(lighting.lights[2].specular, "lamp_specular");
    expect_near(lighting.lights[0].direction, {0, 0.6, -0.8});
    EXPECT_EQ(lighting.lights[1].kind, LightKind::spot);
    EXPECT_DOUBLE_EQ(lighting.lights[1].inner_angle, 10 * degree);
    EXPECT_DOUBLE_EQ(lighting.lights[1].outer_angle, 20 * degree);
    EXPECT_EQ(lighting.lights[2].kind, LightKind::point);
    EXPECT_EQ(lighting.lights[2].position, (Vec3{4, 5, 6}));
    const Output& output = scene.output;
    EXPECT_TRUE(output.surface_gradient && output.dp_dx && output.dp_dy && output.marked);
    EXPECT_TRUE(output.roughness && output.slope_covariance);
    EXPECT_EQ(scene.filter.taps, 8);
    EXPECT_TRUE(scene.filter.light_mean && scene.filter.curvature);
    EXPECT_TRUE(output.passthrough && output.half && output.condition);
    EXPECT_EQ(scene.budget.max_error, 0.05);
    EXPECT_EQ(scene.budget.sample, 1000);
    EXPECT_EQ(scene.budget.seed, 7);
    EXPECT_FALSE(output.png);
}

TEST_F(GoodScene, DefaultsAreThoseOfTheStructs) {
    const Scene scene = load_with("[[layer]]\nkind = \"noise\"\n");
    EXPECT_TRUE(scene.camera.exr);
    EXPECT_EQ(scene.camera.max_residual, 0.5);
    EXPECT_EQ(scene.lighting.relight, Relight::off);
    EXPECT_TRUE(scene.output.png);
    EXPECT_EQ(std::get<NoiseLayer>(scene.layers.at(0).bump).octaves, 1);
    EXPECT_TRUE(load("layer = []\n" + frame_).layers.empty());
}

TEST_F(GoodScene, InlineMatricesAndCameraFiles) {
    const std::string gbuffer = "[gbuffer]\nfile = \"frame.exr\"\n[camera]\n";
    const Scene inline_matrices = load(gbuffer + R"(
view = [[1, 0, 0, -1e6], [0, 0, 1, 2], [0, -1, 0, 3.5], [0, 0, 0, 1]]
proj = [[1.5, 0, 0.1, 0], [0, 2, 0, 0], [0, 0, -1, -0.02], [0, 0, -1, 0]]
)");
    ASSERT_TRUE(inline_matrices.camera.inline_camera);
    EXPECT_EQ(inline_matrices.camera.inline_camera->view[0], (std::array<double, 4>{1, 0, 0, -1e6}));
    EXPECT_EQ(inline_matrices.camera.inline_camera->proj[0], (std::array<double, 4>{1.5, 0, 0.1, 0}));
    EXPECT_EQ(load(gbuffer + "file = \"camera.json\"\n").camera.file, folder_ / "camera.json");
    EXPECT_EQ(load(gbuffer + "file = \"textures/camera.####.json\"\n").camera.file,
              folder_ / "textures/camera.####.json");
    EXPECT_EQ(load("camera.from = \"exr\"\ngbuffer.file = \"frame_%04d.exr\"\n").gbuffer.file,
              folder_ / "frame_%04d.exr");
}

TEST_F(GoodScene, RolesByPlane) {
    const Scene scene = load_with("[gbuffer.roles]\nuv.u = \"s\"\n\"uv.v\" = \"t\"\nobject = \"none\"\n");
    EXPECT_EQ(scene.gbuffer.roles,
              (std::map<std::string, std::string>{{"uv.u", "s"}, {"uv.v", "t"}, {"object", "none"}}));
}

TEST_F(GoodScene, TablesInLineAndAbsolutePaths) {
    const Scene scene =
        load("gbuffer = { file = \"" + (folder_ / "frame.exr").string() +
             "\" }\r\ncamera = { from = \"exr\" }\r\nlayer = [\r\n  { kind = \"resolve\" },\r\n  { kind "
             "= \"noise\" },\r\n]\r\n");
    EXPECT_EQ(scene.gbuffer.file, folder_ / "frame.exr");
    ASSERT_EQ(scene.layers.size(), 2u);
    EXPECT_EQ(scene.layers[1].location, (folder_ / "courtyard.toml:5").string());
    EXPECT_EQ(scene.layers[1].name, "noise 2");
}

}  // namespace
}  // namespace wrinkle
