#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "bench_kernel.h"
#include "contests.h"

namespace wrinkle::bench {

namespace {

using Vector = std::array<double, 3>;

/// The nearest IEEE half of a number of at most 65504.
std::uint16_t half_of(float v) {
    const auto bits = std::bit_cast<std::uint32_t>(v);
    const float size = std::abs(v);
    const auto sign = static_cast<std::uint16_t>(bits >> 16 & 0x8000u);
    if (size < 6.103515625e-05F)  // denormal halves are multiples of 2^-24
        return static_cast<std::uint16_t>(sign | static_cast<std::uint32_t>(std::nearbyint(size * 16777216.0F)));
    const std::uint32_t magnitude = (bits & 0x7fffffffu) - (112u << 23);
    return static_cast<std::uint16_t>(sign | (magnitude + 0xfffu + (magnitude >> 13 & 1u)) >> 13);
}

/// Octahedral coordinates of a unit vector as 16-bit integers [Cigolle et al. 2014].
std::array<std::int16_t, 2> octahedral(const Vector& n) {
    const double sum = std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]);
    double u = n[0] / sum, v = n[1] / sum;
    if (n[2] < 0) {
        const double folded = (1 - std::abs(v)) * (u < 0 ? -1 : 1);
        v = (1 - std::abs(u)) * (v < 0 ? -1 : 1), u = folded;
    }
    const auto rounded = [](double t) { return static_cast<std::int16_t>(std::lround(t * 32767)); };
    return {rounded(u), rounded(v)};
}

template <class T>
cl::Buffer buffer(const Device& device, std::vector<T>& values) {
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T), values.data()};
}

double degrees(const Vector& a, const Vector& b) {
    double cross = 0, dot = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
        cross += std::pow(a[i] * b[j] - a[j] * b[i], 2), dot += a[k] * b[k];
    }
    return std::atan2(std::sqrt(cross), dot) * 57.29577951308232;
}

}  // namespace

void measure_storage(const Device& device, Size size, Run& run) {
    const std::size_t pixels = padded(std::size_t{size.width} * size.height);
    constexpr std::uint32_t kSeed = 14;
    std::mt19937 random(kSeed);
    std::normal_distribution<double> normal;
    constexpr std::size_t kPeriod = 65537;  // number of different pixels, which then repeat
    std::vector<Vector> n(kPeriod), g(kPeriod);
    for (std::size_t i = 0; i < kPeriod; ++i) {
        for (double& part : n[i]) part = normal(random);
        for (double& part : g[i]) part = 0.3 * normal(random);
        const double length = std::hypot(n[i][0], n[i][1], n[i][2]);
        for (double& part : n[i]) part /= length;
    }
    std::vector<cl::Buffer> floats, halves, shorts;
    for (std::size_t k = 0; k < 6; ++k) {
        std::vector<float> full(pixels);
        std::vector<std::uint16_t> narrow(pixels);
        std::vector<std::int16_t> folded(pixels);
        for (std::size_t i = 0; i < pixels; ++i) {
            full[i] = static_cast<float>(k < 3 ? n[i % kPeriod][k] : g[i % kPeriod][k - 3]);
            narrow[i] = half_of(full[i]);
            if (k < 2) folded[i] = octahedral(n[i % kPeriod])[k];
        }
        floats.push_back(buffer(device, full)), halves.push_back(buffer(device, narrow));
        if (k < 2) shorts.push_back(buffer(device, folded));
    }
    std::vector<cl::Buffer> out;
    for (int k = 0; k < 3; ++k)
        out.emplace_back(device.context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, pixels * sizeof(float));
    const auto with_out = [&](std::vector<cl::Buffer> in) {
        in.insert(in.end(), out.begin(), out.end());
        return in;
    };
    const BenchKernels kernels(device, "storage.cl"), whole(device, "memory.cl");
    std::vector<Contender> contenders{
        {"float", whole.launcher("wr_resolve_only", with_out(floats), pixels)},
        {"half", kernels.launcher("wr_from_halves", with_out(halves), pixels)},
        {"octahedral normals",
         kernels.launcher("wr_from_octahedral", with_out({shorts[0], shorts[1], floats[3], floats[4], floats[5]}),
                          pixels)}};
    race(contenders, run.rounds);
    constexpr double kBytes[] = {36, 24, 28};
    for (std::size_t c = 0; c < contenders.size(); ++c) {
        contenders[c].work();
        std::array<std::vector<float>, 3> got;
        for (std::size_t k = 0; k < 3; ++k) {
            got[k].resize(pixels);
            device.queue.enqueueReadBuffer(out[k], CL_TRUE, 0, pixels * sizeof(float), got[k].data());
        }
        std::vector<double> errors;
        for (std::size_t i = 0; i < kPeriod && i < pixels; ++i) {
            const Vector want{n[i][0] - g[i][0], n[i][1] - g[i][1], n[i][2] - g[i][2]};
            errors.push_back(degrees({got[0][i], got[1][i], got[2][i]}, want));
        }
        Measurement m = measured("storage", "resolve_from", contenders[c], device.info.lanes, pixels);
        m.bytes = kBytes[c];
        m.error = statistics(std::move(errors));
        m.hash = hash_of(got[0].data(), pixels * sizeof(float));
        run.measurements.push_back(m);
    }
}

}  // namespace wrinkle::bench
