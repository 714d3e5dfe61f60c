#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <iostream>
#include <map>
#include <string>
#include <vector>

#include "io/camera_file.h"
#include "io/gbuffer_reader.h"
#include "tests/device/test_device.h"
#include "tests/reference/evaluate.h"
#include "tests/reference/scene_images.h"
#include "tests/reference/test_frame.h"
#include "wrinkle/error.h"
#include "wrinkle/passes.h"

/// Frames in memory, runs of passes on them, and errors by the references.
namespace wrinkle::test {

namespace fs = std::filesystem;
using Pixels = std::map<std::string, std::vector<float>>;
using V = reference::Vec<double>;
using reference::orthographic_camera;
using reference::plane_frame;
using reference::test_camera;
using reference::tilted_camera;

inline const fs::path data_folder = fs::path(WRINKLE_SOURCE_DIR) / "data";

inline const Device& device() { return test_device(); }

/// A frame with its pixels.
struct HostFrame {
    Frame frame;
    Pixels pixels;

    HostFrame() = default;
    HostFrame(const reference::TestFrame& made, const Camera& camera) : pixels(made.pixels) {
        frame.size = made.size;
        frame.camera = camera;
        for (const auto& [name, values] : pixels) frame.planes.insert(name);
    }

    std::size_t count() const { return std::size_t{frame.size.width} * frame.size.height; }
    std::vector<float>& add(const std::string& name, float value = 0) {
        frame.planes.insert(name);
        return pixels[name] = std::vector<float>(count(), value);
    }
    void remove(const std::string& name) {
        frame.planes.erase(name);
        pixels.erase(name);
    }
    HostPlanes planes() const { return {pixels.begin(), pixels.end()}; }
};

/// A camera with axes that are orthonormal to double precision. Those of camera files are so only to float precision,
/// and then inverting the view matrix, and transposing it as the references do, give points that differ by more than a
/// kernel's rounding.
inline Camera orthonormal(Camera camera) {
    const auto row = [&](int i) { return V{camera.view[i][0], camera.view[i][1], camera.view[i][2]}; };
    const Mat4 world = inverse(camera.view);
    const V eye{world[0][3], world[1][3], world[2][3]};
    const V x = normalize(row(0)), y = normalize(row(1) - x * dot(x, row(1))), axes[] = {x, y, cross(x, y)};
    for (int i = 0; i < 3; ++i) camera.view[i] = {axes[i].x, axes[i].y, axes[i].z, -dot(axes[i], eye)};
    return camera;
}

/// A frame of data/gbuffer, with all of its channels.
inline HostFrame data_frame(const std::string& name) {
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

inline HostFrame small_frame() { return data_frame("small"); }

/// A scene of data/scenes, with `marked` written as well, and with one point a pixel: tests of the formulas compare it
/// with references that have one. tests/run/area_test.cpp has the others.
inline Scene data_scene(const std::string& name) {
    Scene scene = load_scene(data_folder / "scenes" / (name + ".toml"));
    scene.output.marked = true;
    scene.filter.taps = 1;
    return scene;
}

/// A scene that took some layer twice: names are unique.
inline Scene with_own_names(Scene scene) {
    for (std::size_t i = 0; i < scene.layers.size(); ++i) scene.layers[i].name += fmt::format(", {}", i);
    return scene;
}

/// Runs a pass on host memory, and gives all of its outputs.
template <class T = float>
std::map<std::string, std::vector<T>> run(Pass& pass, const HostFrame& frame) {
    std::map<std::string, std::vector<T>> out;
    std::map<std::string, std::span<T>> spans;
    for (const std::string& name : pass.outputs()) spans[name] = out[name] = std::vector<T>(frame.count(), T(-77));
    pass.run(frame.planes(), spans);
    return out;
}

inline Pixels evaluate_area(const HostFrame& frame, const Scene& scene, const PassOptions& options = {}) {
    Pass pass = evaluate(device(), scene, frame.frame, options);
    return run(pass, frame);
}

/// With one point a pixel, as the references have.
inline Pixels evaluate_on(const HostFrame& frame, Scene scene, const PassOptions& options = {}) {
    scene.filter.taps = 1;
    return evaluate_area(frame, scene, options);
}

template <class T>
V vec_at(const std::map<std::string, std::vector<T>>& planes, const std::string& name, std::size_t i) {
    const bool color = planes.contains(name + ".r");
    const auto part = [&](const char* axis) { return static_cast<double>(planes.at(name + "." + axis)[i]); };
    return color ? V{part("r"), part("g"), part("b")} : V{part("x"), part("y"), part("z")};
}

/// The median, 99% and largest of some numbers, and how many were not finite.
struct Spread {
    double median = 0, p99 = 0, max = 0;
    std::size_t count = 0, non_finite = 0;

    explicit Spread(std::vector<double> errors) {
        non_finite = static_cast<std::size_t>(std::erase_if(errors, [](double e) { return !std::isfinite(e); }));
        count = errors.size();
        if (errors.empty()) return;
        std::ranges::sort(errors);
        median = errors[count / 2], p99 = errors[(count - 1) * 99 / 100], max = errors.back();
    }
};

inline void print(const std::string& what, const Spread& s, const char* unit) {
    fmt::print("{:<34} median {:.2e}  p99 {:.2e}  max {:.2e} {}; {} pixels, {} not finite\n", what, s.median, s.p99,
               s.max, unit, s.count, s.non_finite);
}

struct Bounds {
    double median = 0, p99 = 0, max = 0;
};

inline void expect_within(const std::string& what, const Spread& s, const Bounds& bounds, const char* unit) {
    print(what, s, unit);
    EXPECT_EQ(s.non_finite, 0u) << what;
    EXPECT_LE(s.median, bounds.median) << what;
    EXPECT_LE(s.p99, bounds.p99) << what;
    EXPECT_LE(s.max, bounds.max) << what;
}

/// The answers of the reference for every pixel.
struct Truth {
    std::vector<reference::Evaluated<double>> pixels;
    std::vector<V> lit;

    Truth(const HostFrame& frame, const Scene& given) {
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
};

/// The angles, in degrees, between the normals of a run and the true ones at all valid pixels but those left out.
/// Normals of invalid pixels must have stayed as they were.
template <class T>
Spread normal_error(const std::map<std::string, std::vector<T>>& got, const Truth& truth,
                    const std::vector<bool>& left_out = {}) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const V normal = vec_at(got, "normal", i);
        if (!left_out.empty() && left_out[i]) continue;
        if (truth.pixels[i].valid)
            errors.push_back(angle_degrees(normal, truth.pixels[i].normal));
        else
            EXPECT_EQ(length(normal - truth.pixels[i].normal), 0) << "invalid pixel " << i;
    }
    return Spread(std::move(errors));
}

/// The number of pixels whose `marked` differs from the true one.
template <class T>
std::size_t marked_differences(const std::map<std::string, std::vector<T>>& got, const Truth& truth) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        if (got.at("marked")[i] != static_cast<T>(truth.pixels[i].marked)) ++count;
    return count;
}

/// The largest difference between any two outputs of two runs.
template <class A, class B>
double largest_difference(const std::map<std::string, std::vector<A>>& a,
                          const std::map<std::string, std::vector<B>>& b) {
    double largest = 0;
    for (const auto& [name, values] : a)
        for (std::size_t i = 0; i < values.size(); ++i)
            if (const double d = std::abs(double(values[i]) - double(b.at(name)[i])); !(d <= largest)) largest = d;
    return largest;
}

}  // namespace wrinkle::test
