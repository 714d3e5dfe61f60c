#include "volume.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <random>

#include "baseline/volume.h"
#include "device/program.h"
#include "resources/volume_heap.h"
#include "run/plane_buffers.h"
#include "tests/reference/volume.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

constexpr std::size_t kPixels = std::size_t{1} << 20;  // points of a walk
constexpr std::size_t kRow = 1024;

/// A smooth field; every voxel differs from its neighbours.
float voxel(int x, int y, int z) {
    return static_cast<float>(std::sin(0.31 * x + 0.11 * y) + std::sin(0.27 * y - 0.13 * z) +
                              std::sin(0.23 * z + 0.17 * x));
}

/// The field as a Volume without empty blocks.
Volume blocks_of(int size) {
    Volume volume;
    const int edge = Volume::edge, count = size / edge;
    volume.info.grid = "field";
    volume.count = {count, count, count};
    for (int z = 0; z < count; ++z)
        for (int y = 0; y < count; ++y)
            for (int x = 0; x < count; ++x) {
                volume.blocks.push_back(static_cast<std::int32_t>(volume.blocks.size()));
                for (int k = 0; k < edge; ++k)
                    for (int j = 0; j < edge; ++j)
                        for (int i = 0; i < edge; ++i)
                            volume.voxels.push_back(voxel(x * edge + i, y * edge + j, z * edge + k));
            }
    return volume;
}

using Points = std::array<std::vector<float>, 3>;

/// Folds a coordinate back and forth between the faces of the grid, so that walks stay inside.
float within(double v, int size) {
    const double span = size - 4, period = 2 * span;
    double at = std::fmod(v, period);
    if (at < 0) at += period;
    return static_cast<float>(1.5 + (at < span ? at : period - at));
}

Points plane_walk(double voxels_per_pixel, int size) {
    const double right[] = {0.81, 0.43, 0.4}, down[] = {-0.42, 0.9, -0.12};  // about unit
    Points points;
    for (std::size_t i = 0; i < kPixels; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            points[axis].push_back(within(0.3 * size + voxels_per_pixel * (right[axis] * static_cast<double>(i % kRow) +
                                                                           down[axis] * static_cast<double>(i / kRow)),
                                          size));
    return points;
}

Points random_walk(int size) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<float> uniform(1.5f, static_cast<float>(size) - 2.5f);
    Points points;
    for (auto& axis : points)
        for (std::size_t i = 0; i < kPixels; ++i) axis.push_back(uniform(engine));
    return points;
}

using Sample = reference::NoiseValue<double> (*)(const reference::Voxels<double>&, reference::Vec<double>);

/// Relative errors of gradients at a sample of the points.
ErrorStats errors_of(Sample exact, const Points& points, const std::array<const float*, 3>& gradient) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < kPixels; i += 97) {
        const reference::Vec<double> want = exact([](int x, int y, int z) { return double{voxel(x, y, z)}; },
                                                  {points[0][i], points[1][i], points[2][i]})
                                                .gradient;
        const reference::Vec<double> got{gradient[0][i], gradient[1][i], gradient[2][i]};
        errors.push_back(length(got - want) / length(want));
    }
    return statistics(std::move(errors));
}

std::string kernel_text() {
    std::ifstream in(WRINKLE_SOURCE_DIR "/bench/kernels/volume.cl");
    if (!in) throw Error("cannot read bench/kernels/volume.cl");
    return {std::istreambuf_iterator<char>(in), {}};
}

template <class T>
cl::Buffer buffer(const Device& device, std::vector<T>& values) {
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T), values.data()};
}

/// A kernel and the volume that it samples.
struct Sampler {
    const char* name;
    Sample exact;
    cl::Kernel kernel;
    cl::Buffer texels, table;

    Sampler(const Device& device, const BuiltProgram& built, const Volume& volume, bool smooth)
        : name(smooth ? "quadratic B-spline" : "standard"),
          exact(smooth ? reference::quadratic_spline<double> : reference::trilinear<double>),
          kernel(built.program, smooth ? "wr_smooth_samples" : "wr_linear_samples") {
        TextureHeap heap;
        add_volume(heap, volume, smooth ? TexelKind::volume_smooth : TexelKind::volume);
        heap.texels.resize(heap.texels.size() + 4);
        texels = buffer(device, heap.texels), table = buffer(device, heap.table);
    }
};

}  // namespace

void measure_volumes(const Device& device, int size, Run& run) {
    const baseline::NanoVolume nano(size, voxel);
    const Volume volume = blocks_of(size);
    const BuiltProgram built = build_program(device, kernel_text(), {device.info.lanes, false});
    std::vector<Sampler> samplers{{device, built, volume, false}, {device, built, volume, true}};
    const std::vector<std::string> inputs{"x", "y", "z"}, outputs{"value", "gx", "gy", "gz"};
    PlaneBuffers in(device, inputs, kPixels, sizeof(float)), out(device, outputs, kPixels, sizeof(float));
    const auto launch = [&](Sampler& sampler) {
        cl_uint i = 0;
        for (const cl::Buffer* b : {&sampler.texels, &sampler.table}) sampler.kernel.setArg(i++, *b);
        for (const std::string& name : inputs) sampler.kernel.setArg(i++, in.planes().at(name));
        for (const std::string& name : outputs) sampler.kernel.setArg(i++, out.planes().at(name));
        device.queue.enqueueNDRangeKernel(sampler.kernel, cl::NullRange,
                                          cl::NDRange(kPixels / static_cast<std::size_t>(device.info.lanes)),
                                          cl::NDRange(64));
        device.queue.finish();
    };
    const struct {
        const char* name;
        Points points;
    } walks[] = {{"coherent, 0.2 voxels a pixel", plane_walk(0.2, size)},
                 {"sparse, 1.4 voxels a pixel", plane_walk(1.4, size)},
                 {"random points", random_walk(size)}};
    for (const auto& walk : walks) {
        for (std::size_t axis = 0; axis < 3; ++axis)
            std::ranges::copy(walk.points[axis], in.map<float>(inputs[axis], CL_MAP_WRITE));
        in.unmap();
        std::array<std::vector<float>, 4> host;
        for (auto& plane : host) plane.resize(kPixels);
        std::span<const float> points[] = {walk.points[0], walk.points[1], walk.points[2]};
        std::span<float> gradients[] = {host[1], host[2], host[3]};
        std::vector<Contender> contenders{
            {"NanoVDB C++, gradient", [&] { nano.gradients(points, gradients); }},
            {"NanoVDB C++, both", [&] { nano.values_and_gradients(points, host[0], gradients); }}};
        for (Sampler& sampler : samplers) contenders.push_back({sampler.name, [&] { launch(sampler); }});
        race(contenders, run.rounds);
        for (std::size_t i = 0; i < contenders.size(); ++i) {
            const bool kernel = i >= 2;
            Measurement m = measured("volume", walk.name, contenders[i], kernel ? device.info.lanes : 0, kPixels);
            m.bytes = i == 0 ? 24 : 28;
            m.unit = "relative";
            contenders[i].work();
            if (kernel) {
                std::array<const float*, 3> planes{};
                for (std::size_t k = 0; k < 3; ++k) planes[k] = out.map<float>(outputs[k + 1], CL_MAP_READ);
                m.error = errors_of(samplers[i - 2].exact, walk.points, planes);
                m.hash = hash_of(planes[0], kPixels * sizeof(float));
                out.unmap();
            } else {
                m.error = errors_of(reference::trilinear<double>, walk.points,
                                    {host[1].data(), host[2].data(), host[3].data()});
            }
            run.measurements.push_back(std::move(m));
        }
    }
}

}  // namespace wrinkle::bench
