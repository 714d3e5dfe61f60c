#include "tools/area_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>
#include <set>

#include "base/imath.h"
#include "base/limits.h"
#include "device/guarded.h"
#include "run/normals_only.h"
#include "run/open_frame.h"
#include "run/pass_impl.h"
#include "run/plane_buffers.h"
#include "tools/pixel_points.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

using Imath::V3d;

constexpr double kTilted = 1e-4;  // degrees; rounding turns normals by less

const std::vector<std::string> kNormals{"normal.x", "normal.y", "normal.z"};

Scene with_taps(const Scene& scene, int taps) {
    Scene other = normals_only(scene);
    other.filter.taps = taps;
    return other;
}

template <class T>
V3d normal_at(const T* const (&planes)[3], std::size_t i) {
    return {static_cast<double>(planes[0][i]), static_cast<double>(planes[1][i]), static_cast<double>(planes[2][i])};
}

double degrees_between(const V3d& a, const V3d& b) { return angle_degrees({a.x, a.y, a.z}, {b.x, b.y, b.z}); }

/// A pixel, and the normal of the mean surface gradient over its area.
struct Truth {
    std::size_t pixel = 0;
    V3d base, normal;
};

/// Integrates pixels, one after another, by a pass that sees nothing else.
class Integral {
public:
    Integral(const Device& device, Pass pass, const PixelPoints& points)
        : points_(points),
          fp64_(device.info.fp64),
          pass_(std::move(pass)),
          in_(device, pass_.inputs(), kPointsOfPixel, sizeof(float)),
          out_(device, pass_.outputs(), kPointsOfPixel, pass_.impl().bytes_per_output()) {}

    bool fp64() const { return fp64_; }

    /// The mean over the area of pixel (x, y); nothing where there is none to trust.
    std::optional<Truth> over(std::uint32_t x, std::uint32_t y, std::size_t pixel) {
        std::map<std::string, float*> planes;
        for (const std::string& name : pass_.inputs()) planes[name] = in_.map<float>(name, CL_MAP_WRITE);
        const bool whole = points_.write(x, y, planes);
        in_.unmap();
        if (!whole) return std::nullopt;
        pass_.set_camera(points_.camera(x, y));
        pass_.impl()
            .enqueue(in_.planes(), out_.planes(), {.first = 0, .count = kPointsAlong}, both_ready(in_, out_))
            .wait();
        const V3d base = to_imath(points_.normal(x, y).value());
        const auto mean = fp64_ ? mean_normal<double>(base) : mean_normal<float>(base);
        if (!mean) return std::nullopt;
        return Truth{pixel, base, *mean};
    }

private:
    template <class T>
    std::optional<V3d> mean_normal(const V3d& base) {
        const T* planes[3];
        for (std::size_t k = 0; k < 3; ++k) planes[k] = out_.map<T>(kNormals[k], CL_MAP_READ);
        const T* marked = out_.map<T>("marked", CL_MAP_READ);
        V3d gradient(0);
        bool whole = true;
        for (std::size_t i = 0; i < kPointsOfPixel; ++i) {
            const V3d n = normal_at(planes, i);
            const double facing = n.dot(base);
            whole = whole && facing > 0 && (static_cast<int>(marked[i]) & Marked::invalid) == 0;
            gradient += base - n / facing;
        }
        out_.unmap();
        if (!whole) return std::nullopt;
        return (base - gradient / static_cast<double>(kPointsOfPixel)).normalized();
    }

    const PixelPoints& points_;
    bool fp64_;
    Pass pass_;
    PlaneBuffers in_, out_;
};

/// The planes that any of them reads.
std::vector<std::string> read_by(const std::vector<Pass>& passes, const Pass& another) {
    std::set<std::string> names(another.inputs().begin(), another.inputs().end());
    for (const Pass& pass : passes) names.insert(pass.inputs().begin(), pass.inputs().end());
    return {names.begin(), names.end()};
}

/// The frame's own pass: what it costs and errs by.
TapsError compare(Pass& pass, const PlaneBuffers& in, PlaneBuffers& out, const std::vector<Truth>& truths,
                  std::size_t pixels, std::uint32_t rows, int repeat) {
    std::vector<double> seconds;
    for (int k = 0; k <= repeat; ++k) {  // the first one is warmer
        const auto began = std::chrono::steady_clock::now();
        pass.impl().enqueue(in.planes(), out.planes(), {.first = 0, .count = rows}, both_ready(in, out)).wait();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        if (k > 0) seconds.push_back(took.count());
    }
    pass.impl().save();
    std::ranges::nth_element(seconds, seconds.begin() + repeat / 2);
    const float* planes[3];
    for (std::size_t k = 0; k < 3; ++k) planes[k] = out.map<float>(kNormals[k], CL_MAP_READ);
    std::vector<double> degrees;
    for (const Truth& truth : truths) degrees.push_back(degrees_between(normal_at(planes, truth.pixel), truth.normal));
    out.unmap();
    return {.taps = 0,
            .ns = 1e9 * seconds[static_cast<std::size_t>(repeat / 2)] / static_cast<double>(pixels),
            .degrees = statistics(std::move(degrees))};
}

}  // namespace

AreaErrors measure_area(const Scene& scene, const AreaOptions& options) {
    return guarded("measure the area of pixels", [&] {
        GBufferReader reader = open_frame(scene, options.frame);
        const Frame frame = frame_of(scene, reader, camera_of_frame(scene, reader, options.frame));
        const Device device = Device::open(options.device);
        const auto [width, height] = frame.size;
        const std::size_t pixels = std::size_t{width} * height;
        TextureStore store(device);
        std::vector<Pass> passes;
        for (const int taps : options.taps)
            passes.push_back(evaluate(device, with_taps(scene, taps), frame, {}, &store));

        // Of the camera only the kind counts; each pixel sets its own. Points of one pixel are no pixels of a picture.
        Frame area = frame;
        area.size = {kPointsAlong, kPointsAlong};
        area.beauty_scale = 1;
        Pass points_pass = evaluate(device, with_taps(scene, 1), area, {.fp64 = device.info.fp64}, &store);

        const std::vector<std::string> names = read_by(passes, points_pass);
        check_memory(reader.path().string(), 4.0 * static_cast<double>(pixels * (names.size() + kNormals.size() + 1)),
                     fmt::format("{} planes of {} x {} pixels", names.size(), width, height));
        PlaneBuffers in(device, names, pixels, sizeof(float));
        std::vector<float*> into;
        PixelPoints::Planes planes;
        for (const std::string& name : names) {
            into.push_back(in.map<float>(name, CL_MAP_WRITE));
            planes[name] = {into.back(), pixels};
        }
        reader.read_rows(0, height, names, into);

        AreaErrors errors;
        std::vector<Truth> truths;
        {
            const PixelPoints points(frame, planes);
            Integral integral(device, std::move(points_pass), points);
            errors.fp64 = integral.fp64();
            std::mt19937_64 random(static_cast<std::uint64_t>(options.seed));
            const auto wanted = static_cast<std::size_t>(options.sample);
            for (std::size_t drawn = 0; truths.size() < wanted && drawn < 20 * wanted; ++drawn) {
                const std::size_t pixel = random() % pixels;
                const auto truth = integral.over(static_cast<std::uint32_t>(pixel % width),
                                                 static_cast<std::uint32_t>(pixel / width), pixel);
                if (truth && (!options.bumped || degrees_between(truth->base, truth->normal) > kTilted))
                    truths.push_back(*truth);
                else
                    ++errors.passed_over;
            }
        }
        if (truths.empty())
            throw Error(fmt::format("{}: none of {} pixels shows a {}surface whose area can be integrated",
                                    reader.path().string(), errors.passed_over, options.bumped ? "bumped " : ""));
        in.unmap();
        std::vector<double> unbumped;
        for (const Truth& truth : truths) unbumped.push_back(degrees_between(truth.base, truth.normal));
        errors.unbumped = statistics(std::move(unbumped));
        for (std::size_t k = 0; k < passes.size(); ++k) {
            PlaneBuffers out(device, passes[k].outputs(), pixels, sizeof(float));
            errors.taps.push_back(compare(passes[k], in, out, truths, pixels, height, options.repeat));
            errors.taps.back().taps = options.taps[k];
        }
        return errors;
    });
}

}  // namespace wrinkle
