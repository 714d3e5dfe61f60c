#include "bench_kernel.h"
#include "contests.h"
#include "device/program.h"
#include "frame.h"
#include "tests/reference/camera_rays.h"

namespace wrinkle::bench {

namespace {

const char* const kAxes[] = {"x", "y", "z"};

/// Relative errors of dp/dx and dp/dy to r (n x (dx x d)) / (n . d) in long double, at a sample of valid pixels.
ErrorStats derivative_error(const BenchFrame& frame, PlaneBuffers& out) {
    using T = long double;
    const Size size = frame.frame.size;
    const auto rays = *pinhole_rays(frame.frame.camera, size);
    const float *depth = frame.planes.at("depth").data(), *got[6];
    for (std::size_t k = 0; k < 6; ++k)
        got[k] = out.map<float>(std::string(k < 3 ? "dp_dx." : "dp_dy.") + kAxes[k % 3], CL_MAP_READ);
    std::vector<double> errors;
    for (std::size_t i = 0; i < frame.pixels(); i += 991) {
        T n[3], d[3], length = 0, n_d = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            n[k] = frame.planes.at(std::string("normal.") + kAxes[k])[i];
            d[k] = rays.d0[k] + (i % size.width + T(0.5)) * rays.dx[k] + (i / size.width + T(0.5)) * rays.dy[k];
            length += n[k] * n[k];
        }
        const T z = depth[i];
        if (!(z > 0 && z < 1e9L) || !(length > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k) n[k] /= std::sqrt(length), n_d += n[k] * d[k];
        // Errors grow as 1 / cosine of the angle of view; below 0.02 they are not compared.
        if (n_d > -0.02L * std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])) continue;
        for (const bool down : {false, true}) {
            const Vec3& axis = down ? rays.dy : rays.dx;
            T n_axis = 0, off = 0, size2 = 0;
            for (std::size_t k = 0; k < 3; ++k) n_axis += n[k] * axis[k];
            for (std::size_t k = 0; k < 3; ++k) {
                const T want = z * (axis[k] - d[k] * n_axis / n_d);
                off += (got[k + (down ? 3 : 0)][i] - want) * (got[k + (down ? 3 : 0)][i] - want), size2 += want * want;
            }
            errors.push_back(static_cast<double>(std::sqrt(off / size2)));
        }
    }
    out.unmap();
    return statistics(std::move(errors));
}

}  // namespace

void measure_screen(const Device& device, Size size, Run& run) {
    const Scene scene = load_scene(stack_scene());
    const BenchFrame frame = Resampler(scene).frame(size);
    Frame wanted = frame.frame;
    wanted.planes = {"depth", "normal.x", "normal.y", "normal.z"};
    Pass pass = screen_derivatives(device, wanted);
    PlaneBuffers in = upload(device, frame, pass.inputs()), out(device, pass.outputs(), frame.pixels(), sizeof(float)),
                 copied(device, pass.outputs(), frame.pixels(), sizeof(float));
    BenchKernels kernels(device, "memory.cl");
    std::vector<cl::Buffer> arguments;
    for (const std::string& name : pass.inputs()) arguments.push_back(in.planes().at(name));
    for (const std::string& name : pass.outputs()) arguments.push_back(copied.planes().at(name));
    const auto copy = kernels.launcher("wr_copy_four_to_six", arguments, frame.pixels());
    std::vector<Contender> contenders{{"standard", [&] { pass.enqueue(in.planes(), out.planes()).wait(); }},
                                      {"same bytes", copy}};
    race(contenders, run.rounds);
    Measurement m{.group = "screen",
                  .name = "screen_derivatives",
                  .variant = "standard",
                  .lanes = device.info.lanes,
                  .pixels = frame.pixels(),
                  .seconds = contenders[0].seconds,
                  .bytes = 40,
                  .unit = "relative"};
    m.error = derivative_error(frame, out);
    m.bound = 1e-6 / 0.02;
    run.measurements.push_back(m);
    m.name = "copy", m.variant = "same bytes", m.seconds = contenders[1].seconds, m.error = {}, m.bound = 0;
    m.error.samples = frame.pixels();
    const std::string& from = pass.inputs().front();
    const float *a = in.map<float>(from, CL_MAP_READ), *b = copied.map<float>(pass.outputs().front(), CL_MAP_READ);
    for (std::size_t i = 0; i < frame.pixels(); ++i)
        m.error.max = std::max(m.error.max, a[i] == b[i] ? 0.0 : std::abs(double{a[i]} - double{b[i]}));
    run.measurements.push_back(m);
}

}  // namespace wrinkle::bench
