#include "run/bands.h"

#include <algorithm>

#include "plan/stored_planes.h"

namespace wrinkle {

namespace {

std::size_t input_bytes(const Pass::Impl& impl, const std::string& name) {
    return pixel_bytes(name, impl.plan.formats);
}

}  // namespace

Rows BandGrid::rows_of(std::uint32_t band) const {
    const std::uint32_t first = band * rows, count = std::min(rows, size.height - first);
    return {.first = first,
            .count = count,
            .before = std::min(halo, first),
            .after = std::min(halo, size.height - first - count)};
}

std::size_t band_pixels(const DeviceInfo& device, std::size_t frame_pixels, double bytes_of_pixel, double widest,
                        std::uint32_t in_flight) {
    constexpr std::size_t kCore = 1 << 16, kMostCores = 16, kUnit = 1 << 14, kLeast = 1 << 18, kMost = 1 << 22;
    const std::size_t units = device.compute_units;
    const std::size_t cores = in_flight == 1 ? kMostCores : std::clamp<std::size_t>(units, 2, kMostCores);
    const std::size_t wanted =
        device.own_memory ? std::clamp(std::min(units * kUnit, frame_pixels / 8), kLeast, kMost) : cores * kCore;
    const double fit = std::min(static_cast<double>(device.memory) / (16 * in_flight * bytes_of_pixel),
                                static_cast<double>(device.largest_buffer) / widest);
    return static_cast<std::size_t>(std::clamp(fit, 1.0, static_cast<double>(wanted)));
}

BandGrid band_grid(const Pass::Impl& impl, std::uint32_t step, std::uint32_t in_flight) {
    double all = 0, widest = 1;
    const auto add = [&](std::size_t bytes) {
        all += static_cast<double>(bytes);
        widest = std::max(widest, static_cast<double>(bytes));
    };
    for (const std::string& name : impl.plan.input_memories) add(input_bytes(impl, name));
    for (const std::string& name : impl.plan.output_memories) add(impl.output_bytes(name));
    const auto [width, height] = impl.size;
    const std::size_t pixels =
        band_pixels(impl.device.info, std::size_t{width} * height, std::max(all, 1.0), widest, in_flight);
    const std::size_t rows = std::max<std::size_t>(pixels / width / step * step, step);
    return {.size = impl.size,
            .rows = static_cast<std::uint32_t>(std::min<std::size_t>(rows, height)),
            .halo = impl.plan.neighbours ? 1u : 0u};
}

Band::Band(const Pass::Impl& impl, const BandGrid& grid, const std::vector<std::string>& names)
    : inputs(impl.device, names, grid.read_pixels(), [&](const std::string& name) { return input_bytes(impl, name); }),
      outputs(impl.device, impl.plan.output_memories, grid.pixels(),
              [&](const std::string& name) { return impl.output_bytes(name); }) {}

void Band::begin(const BandGrid& grid, std::uint32_t band) {
    rows = grid.rows_of(band);
    const std::size_t width = grid.size.width;
    inputs.hold(width * (rows.before + rows.count + rows.after));
    outputs.hold(width * rows.count);
}

cl::Event Band::enqueue(Pass::Impl& impl, const Rows& of) {
    const cl::Event done = impl.enqueue(inputs.planes(), outputs.planes(), of, both_ready(inputs, outputs));
    impl.device.queue.flush();
    return done;
}

}  // namespace wrinkle
