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
    HostFrame(const reference::TestFrame& made, const Camera& camera);

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
Camera orthonormal(Camera camera);

/// A frame of data/gbuffer, with all of its channels.
HostFrame data_frame(const std::string& name);

inline HostFrame small_frame() { return data_frame("small"); }

/// A scene of data/scenes, with `marked` written as well, and with one point a pixel: tests of the formulas compare it
/// with references that have one. tests/run/area_test.cpp has the others.
Scene data_scene(const std::string& name);

/// A scene that took some layer twice: names are unique.
Scene with_own_names(Scene scene);

/// Runs a pass on host memory, and gives all of its outputs.
template <class T = float>
std::map<std::string, std::vector<T>> run(Pass& pass, const HostFrame& frame) {
    std::map<std::string, std::vector<T>> out;
    std::map<std::string, std::span<T>> spans;
    for (const std::string& name : pass.outputs()) spans[name] = out[name] = std::vector<T>(frame.count(), T(-77));
    pass.run(frame.planes(), spans);
    return out;
}

/// On the lanes that WRINKLE_TEST_LANES names, if it names one and `options` none.
Pixels evaluate_area(const HostFrame& frame, const Scene& scene, PassOptions options = {});

/// With one point a pixel, as the references have.
Pixels evaluate_on(const HostFrame& frame, Scene scene, const PassOptions& options = {});

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

    explicit Spread(std::vector<double> errors);
};

void print(const std::string& what, const Spread& s, const char* unit);

struct Bounds {
    double median = 0, p99 = 0, max = 0;
};

void expect_within(const std::string& what, const Spread& s, const Bounds& bounds, const char* unit);

/// The answers of the reference for every pixel.
struct Truth {
    std::vector<reference::Evaluated<double>> pixels;
    std::vector<V> lit;

    Truth(const HostFrame& frame, const Scene& given);
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

/// The largest difference between any two outputs of two runs; NaN where one is NaN.
template <class A, class B>
double largest_difference(const std::map<std::string, std::vector<A>>& a,
                          const std::map<std::string, std::vector<B>>& b) {
    double largest = 0;
    for (const auto& [name, values] : a)
        for (std::size_t i = 0; i < values.size(); ++i)
            if (const double d = std::abs(double(values[i]) - double(b.at(name)[i])); std::isnan(d) || d > largest)
                largest = std::isnan(largest) ? largest : d;
    return largest;
}

}  // namespace wrinkle::test
