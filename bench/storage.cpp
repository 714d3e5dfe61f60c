#include <random>

#include "bench_kernel.h"
#include "contests.h"
#include "plan/stored_planes.h"
#include "run/pass_impl.h"
#include "stored_pass.h"

namespace wrinkle::bench {

namespace {

using Vector = reference::Vec<double>;
using enum PlaneEncoding;

const std::vector<std::string> kNormal{"normal.x", "normal.y", "normal.z"},
    kGradient{"channel:g.x", "channel:g.y", "channel:g.z"};

std::vector<StoredWay> ways() {
    std::vector<std::string> all = kNormal, pixels = kNormal, gradients = kGradient, normals = kNormal;
    all.insert(all.end(), kGradient.begin(), kGradient.end()), all.push_back("depth");
    pixels.push_back("depth"), gradients.emplace_back(), normals.emplace_back();
    return {{"float", {}, {}},
            {"half", planar(half, all), planar(half, kNormal)},
            {"octahedral normals, halves",
             united({interleaved("normal", octahedral16, kNormal), planar(half, kGradient), planar(half, {"depth"})}),
             interleaved("normal", octahedral16, kNormal)},
            {"RGBA16F", united({interleaved("pixels", half, pixels), interleaved("gradients", half, gradients)}),
             interleaved("normals", half, normals)}};
}

/// The pixels at which errors are taken.
std::vector<std::size_t> sample_of(const BenchFrame& frame) {
    std::vector<std::size_t> pixels;
    const Size size = frame.frame.size;
    const auto rays = *pinhole_rays(frame.frame.camera, size);
    for (std::size_t i = 0; i < frame.pixels(); i += 997) {
        const double x = static_cast<double>(i % size.width) + 0.5, y = static_cast<double>(i / size.width) + 0.5;
        const auto along = [&](std::size_t axis) { return rays.d0[axis] + x * rays.dx[axis] + y * rays.dy[axis]; };
        const Vector n = vector_at(frame, "normal.", i), ray{along(0), along(1), along(2)};
        const float depth = frame.planes.at("depth")[i];
        // Normals that face away are reflected first; some that nearly do, too, once they are rounded.
        if (depth > 0 && depth < 1e9F && dot(n, ray) < -0.02 * length(n) * length(ray)) pixels.push_back(i);
    }
    return pixels;
}

/// The demo's depth and normals, of unit length, with random gradients.
BenchFrame resolve_frame(Size size) {
    BenchFrame frame = Resampler(load_scene(WRINKLE_SOURCE_DIR "/data/scenes/courtyard.toml")).frame(size);
    constexpr std::uint32_t kSeed = 14;
    std::mt19937 random(kSeed);
    std::normal_distribution<float> part(0, 0.3F);
    std::vector<float> parts(65537);  // which repeat
    for (float& each : parts) each = part(random);
    for (std::size_t k = 0; k < 3; ++k) {
        std::vector<float>& plane = frame.planes[kGradient[k]];
        for (std::size_t i = 0; i < frame.pixels(); ++i) plane.push_back(parts[(3 * i + k) % parts.size()]);
        frame.frame.planes.insert(kGradient[k]);
    }
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
        const Vector n = vector_at(frame, "normal.", i);
        if (length(n) == 0) continue;
        for (std::size_t k = 0; k < 3; ++k)
            frame.planes.at(kNormal[k])[i] = static_cast<float>(frame.planes.at(kNormal[k])[i] / length(n));
    }
    return frame;
}

/// Records a contender, by its normals in `job`. `tangent`: what it resolved is the part of gradients that is tangent
/// to the normal.
void record(Run& run, const char* name, const Contender& contender, int lanes, const BenchFrame& frame,
            const std::vector<std::size_t>& pixels, StoredPass& job, bool tangent, double bytes) {
    const Plan& plan = job.pass.impl().plan;
    const StoredVectors out(job.out, plan.output_formats, "normal.x");
    std::vector<double> errors;
    for (const std::size_t i : pixels) {
        const Vector n = normalize(vector_at(frame, "normal.", i));
        Vector g = vector_at(frame, "channel:g.", i);
        if (tangent) g = g - n * dot(n, g);
        errors.push_back(angle_degrees(out.at(i), normalize(n - g)));
    }
    Measurement m = measured("storage", name, contender, lanes, frame.pixels());
    m.bytes = bytes;
    m.error = statistics(std::move(errors));
    const std::string& memory = job.pass.outputs().front();
    m.hash =
        hash_of(job.out.map<std::byte>(memory, CL_MAP_READ), frame.pixels() * pixel_bytes(memory, plan.output_formats));
    job.out.unmap();
    run.measurements.push_back(m);
}

}  // namespace

void measure_storage(const Device& device, Size size, Run& run) {
    Scene scene;
    scene.layers.resize(1);
    scene.layers[0].name = "gradients", scene.layers[0].bump = GradientLayer{.channels = {"g.x", "g.y", "g.z"}};
    scene.filter.taps = 1;
    const BenchFrame frame = resolve_frame(size);
    const std::vector<std::size_t> pixels = sample_of(frame);
    const std::vector<StoredWay> all = ways();
    std::vector<StoredPass> jobs;
    for (const StoredWay& way : all) jobs.emplace_back(device, scene, frame, way);

    const BenchKernels stored(device, "storage.cl"), floats(device, "memory.cl");
    const char* const kernels[] = {"wr_resolve_only", "wr_resolve_halves", "wr_resolve_octahedral",
                                   "wr_resolve_pixels"};
    std::vector<Contender> alone, passes;
    for (std::size_t k = 0; k < all.size(); ++k) {
        std::vector<cl::Buffer> arguments;
        const Plan& plan = jobs[k].pass.impl().plan;
        for (const std::string& name : memories_of(kNormal, plan.formats))
            arguments.push_back(jobs[k].in.planes().at(name));
        for (const std::string& name : memories_of(kGradient, plan.formats))
            arguments.push_back(jobs[k].in.planes().at(name));
        for (const std::string& name : jobs[0].pass.outputs()) arguments.push_back(jobs[0].out.planes().at(name));
        alone.push_back({all[k].name, (k == 0 ? floats : stored).launcher(kernels[k], arguments, frame.pixels())});
        passes.push_back({all[k].name, [&jobs, k] { jobs[k].run(); }});
    }
    race(alone, run.rounds);
    constexpr double kBytes[] = {36, 24, 22, 28};
    for (std::size_t k = 0; k < all.size(); ++k) {
        alone[k].work();
        record(run, "resolve_from", alone[k], device.info.lanes, frame, pixels, jobs[0], false, kBytes[k]);
    }
    race(passes, run.rounds);
    for (std::size_t k = 0; k < all.size(); ++k) {
        passes[k].work();
        record(run, "resolve_pass", passes[k], device.info.lanes, frame, pixels, jobs[k], true,
               jobs[k].pass.bytes_per_pixel());
    }
}

}  // namespace wrinkle::bench
