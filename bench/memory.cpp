#include "memory.h"

#include <cmath>

#include "baseline/baseline.h"
#include "bench_kernel.h"
#include "run/plane_buffers.h"

namespace wrinkle::bench {

namespace {

constexpr double kFmaOperations = 2.0 * 256 * 12;  // WR_FMA_ROUNDS, WR_FMA_CHAINS

/// Unit normals and gradients that differ from pixel to pixel.
float value_of(char plane, char axis, std::size_t i) {
    const double angle = static_cast<double>(i % 997) * 0.0063;
    if (plane == 'g') return static_cast<float>(0.3 * std::sin(angle * (axis - 'w')));
    return static_cast<float>(axis == 'x' ? 0.6 * std::cos(angle) : axis == 'y' ? 0.6 * std::sin(angle) : 0.8);
}

/// A plane that begins and ends with a cache line.
class AlignedPlane {
public:
    explicit AlignedPlane(std::size_t pixels) : lines_((pixels + 15) / 16) {}
    std::span<float> span() { return {lines_.front().v, 16 * lines_.size()}; }

private:
    struct alignas(64) Line {
        float v[16];
    };
    std::vector<Line> lines_;
};

/// The angles between normals that were computed and normalize(n - g) in double.
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
    const BenchKernels kernels(device, "memory.cl");
    const std::vector<std::string> names{"nx", "ny", "nz", "gx", "gy", "gz", "ox", "oy", "oz"};
    PlaneBuffers planes(device, names, pixels, sizeof(float));
    std::vector<AlignedPlane> memory;
    std::vector<std::span<float>> host;
    for (const std::string& name : names) {
        memory.emplace_back(padded(pixels));
        host.push_back(memory.back().span());
        for (std::size_t i = 0; i < host.back().size(); ++i) host.back()[i] = value_of(name[0], name[1], i);
        std::ranges::copy(host.back(), planes.map<float>(name, CL_MAP_WRITE));
    }
    planes.unmap();
    const baseline::ConstPlanes n{host[0], host[1], host[2]}, g{host[3], host[4], host[5]};
    const baseline::Planes out_planes{host[6], host[7], host[8]};

    const auto kernel = [&](const char* name, const std::vector<std::string>& arguments) {
        std::vector<cl::Buffer> buffers;
        for (const std::string& argument : arguments) buffers.push_back(planes.planes().at(argument));
        return kernels.launcher(name, buffers, pixels);
    };
    const auto resolve = kernel("wr_resolve_only", names);
    std::vector<Contender> contenders{
        {"copy", kernel("wr_copy", {"nx", "ny", "nz", "ox", "oy", "oz"})},
        {"triad", kernel("wr_triad", {"nx", "gx", "oz"})},
        {"fma", kernel("wr_fma_chains", {"gx", "oz"})},
        {"resolve", resolve},
        {"resolve, plain C++", [&] { baseline::resolve(n, g, out_planes); }},
        {"resolve, C++ past the cache", [&] { baseline::resolve_streaming(n, g, out_planes); }},
        {"triad, C++ past the cache", [&] { baseline::triad_streaming(host[0], host[3], host[6]); }}};
    race(contenders, run.rounds);
    const Timing cpp_triad = contenders.back().seconds;
    contenders.back().work();
    std::vector<float> triad_result(host[6].begin(), host[6].end());

    const double count = static_cast<double>(pixels) * 1e-9;
    run.ceilings = {24 * count / contenders[0].seconds.median, 12 * count / contenders[1].seconds.median,
                    kFmaOperations * count / contenders[2].seconds.median, 12 * count / cpp_triad.median};
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
    const std::vector<const float*> cpp_out{host[6].data(), host[7].data(), host[8].data()};
    std::vector<const float*> out;
    resolve();
    for (const char* name : {"ox", "oy", "oz"}) out.push_back(planes.map<float>(name, CL_MAP_READ));
    record("standard", device.info.lanes, contenders[3].seconds, out);
    baseline::resolve(n, g, out_planes);
    record("plain C++", 0, contenders[4].seconds, cpp_out);
    baseline::resolve_streaming(n, g, out_planes);
    record("C++ past the cache", 0, contenders[5].seconds, cpp_out);

    std::vector<double> wrong;
    for (std::size_t i = 0; i < pixels; i += 991)
        wrong.push_back(std::abs(triad_result[i] - (host[0][i] + 3.0 * host[3][i])));
    Measurement m{.group = "memory",
                  .name = "triad",
                  .variant = "C++ past the cache",
                  .pixels = pixels,
                  .seconds = cpp_triad,
                  .bytes = 12,
                  .operations = 2,
                  .unit = "absolute",
                  .error = statistics(std::move(wrong))};
    run.measurements.push_back(m);
}

}  // namespace wrinkle::bench
