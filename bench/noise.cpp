#include <bit>
#include <cmath>

#include "bench_kernel.h"
#include "contests.h"
#include "run/plane_buffers.h"
#include "tests/reference/noise.h"

namespace wrinkle::bench {

namespace {

constexpr std::size_t kPixels = std::size_t{1} << 20;
constexpr int kOctaves = 8;  // as WR_OCTAVES in kernels/noise.cl
using Sample = reference::NoiseValue<double>;

/// A pixel's position. Neighbouring pixels lie close to each other, as on a surface.
float coordinate(int axis, std::size_t i) {
    const double x = static_cast<double>(i % 1024) * 0.0137, y = static_cast<double>(i / 1024) * 0.0121;
    return static_cast<float>(axis == 0 ? x : axis == 1 ? y : 0.3 * std::sin(x) + 0.2 * y);
}

/// One octave of the noise of bench/kernels/noise.cl that hashes without a table: over the corners of a cell, the sum
/// of fades times direction . distance.
double hashed_noise(const std::array<double, 3>& p) {
    std::array<std::int32_t, 3> cell{};
    std::array<double, 3> d{};
    for (std::size_t k = 0; k < 3; ++k)
        cell[k] = static_cast<std::int32_t>(std::floor(p[k])), d[k] = p[k] - std::floor(p[k]);
    constexpr std::uint32_t primes[] = {501125321u, 1136930381u, 1720413743u};
    double sum = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        std::uint32_t hash = 0;
        double weight = 1;
        std::array<double, 3> from{};
        for (std::size_t k = 0; k < 3; ++k) {
            const unsigned far = corner >> k & 1;
            hash ^= (static_cast<std::uint32_t>(cell[k]) + far) * primes[k];
            const double t = d[k], fade = t * t * t * (t * (t * 6 - 15) + 10);
            weight *= far != 0 ? fade : 1 - fade;
            from[k] = t - far;
        }
        hash *= 0x27d4eb2du;
        hash ^= static_cast<std::uint32_t>(std::bit_cast<std::int32_t>(hash) >> 15);
        const reference::Vec<double> g = reference::perlin_direction<double>(static_cast<int>(hash & 15));
        sum += weight * (g.x * from[0] + g.y * from[1] + g.z * from[2]);
    }
    return sum;
}

template <class Noise>
Sample octaves(std::size_t i, const Noise& noise) {
    Sample sum;
    for (int k = 0; k < kOctaves; ++k) {
        std::array<double, 3> p{};
        for (int axis = 0; axis < 3; ++axis)
            p[static_cast<std::size_t>(axis)] =
                std::fma(coordinate(axis, i), static_cast<float>(1 << k), 17.25F * static_cast<float>(k));
        const Sample octave = noise(p);
        sum.value += octave.value;
        sum.gradient = sum.gradient + octave.gradient;
    }
    return sum;
}

Sample by_table(const std::array<double, 3>& p) { return reference::perlin_noise<double>({p[0], p[1], p[2]}); }

/// The same with its gradient, by central differences in double, which are exact to 1e-8.
Sample by_hash(const std::array<double, 3>& p) {
    const auto slope = [&](std::size_t axis) {
        constexpr double kStep = 1e-5;
        auto a = p, b = p;
        a[axis] += kStep, b[axis] -= kStep;
        return (hashed_noise(a) - hashed_noise(b)) / (2 * kStep);
    };
    return {hashed_noise(p), {slope(0), slope(1), slope(2)}};
}

}  // namespace

void measure_noise(const Device& device, Run& run) {
    const std::vector<std::string> names{"x", "y", "z", "value", "dx", "dy", "dz"};
    PlaneBuffers planes(device, names, kPixels, sizeof(float));
    for (int axis = 0; axis < 3; ++axis) {
        float* plane = planes.map<float>(names[static_cast<std::size_t>(axis)], CL_MAP_WRITE);
        for (std::size_t i = 0; i < kPixels; ++i) plane[i] = coordinate(axis, i);
    }
    planes.unmap();
    std::vector<cl::Buffer> buffers;
    for (const std::string& name : names) buffers.push_back(planes.planes().at(name));

    struct Way {
        const char *kernel, *variant;
        bool table, gradient;
    };
    constexpr Way ways[] = {{"wr_value_and_gradient", "value and gradient", true, true},
                            {"wr_forward_by_table", "forward differences, by table", true, true},
                            {"wr_forward_by_hash", "forward differences, by hash", false, true},
                            {"wr_value_by_table", "value only, by table", true, false},
                            {"wr_value_by_hash", "value only, by hash", false, false}};
    std::vector<Contender> contenders;
    std::vector<int> widths;
    std::vector<Way> of;
    for (const int lanes : {8, 16}) {
        const BenchKernels kernels(device, "noise.cl", lanes);
        for (const Way& way : ways) {
            contenders.push_back({way.variant, kernels.launcher(way.kernel, buffers, kPixels)});
            widths.push_back(lanes), of.push_back(way);
        }
    }
    race(contenders, run.rounds);
    for (std::size_t k = 0; k < contenders.size(); ++k) {
        contenders[k].work();
        Measurement m = measured("noise", "perlin_noise", contenders[k], widths[k], kPixels * kOctaves);
        m.bytes = 28.0 / kOctaves;
        m.unit = "absolute";
        const float* got[4];
        for (std::size_t c = 0; c < 4; ++c) got[c] = planes.map<float>(names[c + 3], CL_MAP_READ);
        std::vector<double> errors;
        for (std::size_t i = 0; i < kPixels; i += 991) {
            const Sample want = octaves(i, of[k].table ? by_table : by_hash);
            errors.push_back(of[k].gradient ? std::hypot(got[1][i] - want.gradient.x, got[2][i] - want.gradient.y,
                                                         got[3][i] - want.gradient.z)
                                            : std::abs(got[0][i] - want.value));
        }
        m.hash = hash_of(got[of[k].gradient ? 1 : 0], kPixels * sizeof(float));
        planes.unmap();
        m.error = statistics(std::move(errors));
        run.measurements.push_back(m);
    }
}

}  // namespace wrinkle::bench
