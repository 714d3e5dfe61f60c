#include "memory.h"

#include <cmath>
#include <fstream>

#include "baseline/baseline.h"
#include "device/program.h"
#include "run/plane_buffers.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

constexpr double kFmaOperations = 2.0 * 256 * 12;  // WR_FMA_ROUNDS, WR_FMA_CHAINS

std::string kernel_text() {
    std::ifstream in(WRINKLE_SOURCE_DIR "/bench/kernels/memory.cl");
    if (!in) throw Error("cannot read bench/kernels/memory.cl");
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Unit normals and gradients that differ from pixel to pixel.
float value_of(char plane, char axis, std::size_t i) {
    const double angle = static_cast<double>(i % 997) * 0.0063;
    if (plane == 'g') return static_cast<float>(0.3 * std::sin(angle * (axis - 'w')));
    return static_cast<float>(axis == 'x' ? 0.6 * std::cos(angle) : axis == 'y' ? 0.6 * std::sin(angle) : 0.8);
}

/// Angles of planes to normalize(n - g) in double.
ErrorStats resolve_error(const std::vector<const float*>& in, const std::vector<const float*>& out,
                         std::size_t pixels) {
    std::vector<double> degrees;
    for (std::size_t i = 0; i < pixels; i += 991) {
        double w[3], got[3], cross = 0, dot = 0;
        for (std::size_t k = 0; k < 3; ++k) w[k] = double{in[k][i]} - double{in[k + 3][i]}, got[k] = out[k][i];
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
            cross += std::pow(got[a] * w[b] - got[b] * w[a], 2), dot += got[k] * w[k];
        }
        degrees.push_back(std::atan2(std::sqrt(cross), dot) * 57.29577951308232);
    }
    return statistics(std::move(degrees));
}

}  // namespace

void measure_memory(const Device& device, Size size, Run& run) {
    const std::size_t pixels = std::size_t{size.width} * size.height;
    const BuiltProgram built = build_program(device, kernel_text(), {device.info.lanes, false});
    const std::vector<std::string> names{"nx", "ny", "nz", "gx", "gy", "gz", "ox", "oy", "oz"};
    PlaneBuffers planes(device, names, pixels, sizeof(float));
    std::vector<std::vector<float>> host;
    for (const std::string& name : names) {
        host.emplace_back(padded(pixels));
        for (std::size_t i = 0; i < host.back().size(); ++i) host.back()[i] = value_of(name[0], name[1], i);
        std::ranges::copy(host.back(), planes.map<float>(name, CL_MAP_WRITE));
    }
    planes.unmap();

    const auto kernel = [&](const char* name, const std::vector<std::string>& arguments) {
        cl::Kernel k(built.program, name);
        cl_uint i = 0;
        for (const std::string& argument : arguments) k.setArg(i++, planes.planes().at(argument));
        k.setArg(i, static_cast<cl_uint>(pixels));
        return k;
    };
    const cl::Kernel copy = kernel("wr_copy", {"nx", "ny", "nz", "ox", "oy", "oz"}),
                     triad = kernel("wr_triad", {"nx", "gx", "oz"}), fma = kernel("wr_fma_chains", {"gx", "oz"}),
                     resolve = kernel("wr_resolve_only", names);
    const auto lanes = static_cast<std::size_t>(device.info.lanes);
    const std::size_t items = ((pixels + lanes - 1) / lanes + 63) / 64 * 64;
    const auto launch = [&](const cl::Kernel& k) {
        device.queue.enqueueNDRangeKernel(k, cl::NullRange, cl::NDRange(items), cl::NDRange(64));
        device.queue.finish();
    };
    std::vector<Contender> contenders{
        {"copy", [&] { launch(copy); }},
        {"triad", [&] { launch(triad); }},
        {"fma", [&] { launch(fma); }},
        {"resolve", [&] { launch(resolve); }},
        {"resolve, plain C++", [&] {
             baseline::resolve({host[0], host[1], host[2]}, {host[3], host[4], host[5]}, {host[6], host[7], host[8]});
         }}};
    race(contenders, run.repetitions);
    launch(resolve);

    const double count = static_cast<double>(pixels) * 1e-9;
    run.ceilings = {24 * count / contenders[0].seconds.median, 12 * count / contenders[1].seconds.median,
                    kFmaOperations * count / contenders[2].seconds.median};
    const auto record = [&](const char* variant, int width, const Timing& seconds,
                            const std::vector<const float*>& out) {
        Measurement m{.group = "memory",
                      .name = "resolve",
                      .variant = variant,
                      .lanes = width,
                      .pixels = pixels,
                      .seconds = seconds,
                      .bytes = 36,
                      .operations = 14};
        m.error = resolve_error(
            {host[0].data(), host[1].data(), host[2].data(), host[3].data(), host[4].data(), host[5].data()}, out,
            pixels);
        m.hash = hash_of(out[0], pixels * sizeof(float));
        m.bound = 1e-5;
        run.measurements.push_back(m);
    };
    std::vector<const float*> out;
    for (const char* name : {"ox", "oy", "oz"}) out.push_back(planes.map<float>(name, CL_MAP_READ));
    record("standard", device.info.lanes, contenders[3].seconds, out);
    record("plain C++", 0, contenders[4].seconds, {host[6].data(), host[7].data(), host[8].data()});
}

}  // namespace wrinkle::bench
