#include "tests/run/run_frame.h"

#include "io/camera_file.h"
#include "io/gbuffer_reader.h"
#include "tests/reference/scene_images.h"

namespace wrinkle::test {

HostFrame::HostFrame(const reference::TestFrame& made, const Camera& camera) : pixels(made.pixels) {
    frame.size = made.size;
    frame.camera = camera;
    for (const auto& [name, values] : pixels) frame.planes.insert(name);
}

Camera orthonormal(Camera camera) {
    const auto row = [&](int i) { return V{camera.view[i][0], camera.view[i][1], camera.view[i][2]}; };
    const Mat4 world = inverse(camera.view);
    const V eye{world[0][3], world[1][3], world[2][3]};
    const V x = normalize(row(0)), y = normalize(row(1) - x * dot(x, row(1))), axes[] = {x, y, cross(x, y)};
    for (int i = 0; i < 3; ++i) camera.view[i] = {axes[i].x, axes[i].y, axes[i].z, -dot(axes[i], eye)};
    return camera;
}

HostFrame data_frame(const std::string& name) {
    const GBufferReader reader(data_folder / "gbuffer" / (name + ".exr"));
    CameraSource source;
    source.file = data_folder / "gbuffer" / (name + ".camera.json");
    HostFrame out;
    out.frame.size = reader.size();
    out.frame.camera = orthonormal(read_camera(source, reader));
    for (const std::string& name : reader.cryptomatte().names())
        out.frame.cryptomatte[name] = reader.cryptomatte().id(name);
    std::vector<std::string> names = reader.planes();
    for (const std::string& channel : reader.channels()) names.push_back("channel:" + channel);
    std::vector<float*> into;
    for (const std::string& name : names) into.push_back(out.add(name).data());
    reader.read_rows(0, out.frame.size.height, names, into);
    return out;
}

Scene data_scene(const std::string& name) {
    Scene scene = load_scene(data_folder / "scenes" / (name + ".toml"));
    scene.output.marked = true;
    scene.filter.taps = 1;
    return scene;
}

Scene with_own_names(Scene scene) {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) scene.layers[i].name += fmt::format(", {}", i);
    return scene;
}

Pixels evaluate_area(const HostFrame& frame, const Scene& scene, PassOptions options) {
    if (const std::vector<int> lanes = lanes_to_try(); options.lanes == 0 && lanes.size() == 1)
        options.lanes = lanes.front();
    Pass pass = evaluate(device(), scene, frame.frame, options);
    return run(pass, frame);
}

Pixels evaluate_on(const HostFrame& frame, Scene scene, const PassOptions& options) {
    scene.filter.taps = 1;
    return evaluate_area(frame, scene, options);
}

Spread::Spread(std::vector<double> errors) {
    non_finite = static_cast<std::size_t>(std::erase_if(errors, [](double e) { return !std::isfinite(e); }));
    count = errors.size();
    if (errors.empty()) return;
    std::ranges::sort(errors);
    median = errors[count / 2], p99 = errors[(count - 1) * 99 / 100], max = errors.back();
}

void print(const std::string& what, const Spread& s, const char* unit) {
    fmt::print("{:<34} median {:.2e}  p99 {:.2e}  max {:.2e} {}; {} pixels, {} not finite\n", what, s.median, s.p99,
               s.max, unit, s.count, s.non_finite);
}

void expect_within(const std::string& what, const Spread& s, const Bounds& bounds, const char* unit) {
    print(what, s, unit);
    EXPECT_EQ(s.non_finite, 0u) << what;
    EXPECT_LE(s.median, bounds.median) << what;
    EXPECT_LE(s.p99, bounds.p99) << what;
    EXPECT_LE(s.max, bounds.max) << what;
}

Truth::Truth(const HostFrame& frame, const Scene& given) {
    Scene scene = given;
    if (frame.frame.ray_depth) scene.gbuffer.depth = DepthKind::ray;
    const reference::Images images = reference::images_of(scene);
    const reference::SceneEvaluator<double> evaluator(scene, frame.frame.size, frame.frame.camera, frame.planes(),
                                                      images);
    for (std::size_t i = 0; i < frame.count(); ++i) {
        pixels.push_back(evaluator.evaluate(i));
        if (scene.lighting.relight != Relight::off) lit.push_back(evaluator.relit(i, pixels.back()));
    }
}

}  // namespace wrinkle::test
