#include "run/staged_bands.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "plan/stored_planes.h"

namespace wrinkle {

namespace {

constexpr std::size_t kInFlight = 3;
constexpr std::size_t kLeastPixels = std::size_t{1} << 16, kMostPixels = std::size_t{1} << 22;

/// A plane of a band: on the device, and where the host leaves it and finds it.
struct StagedPlane {
    cl::Buffer device, host;
    std::byte* memory = nullptr;
    std::size_t pixel_bytes = 0;
};

/// The planes of a band, and the commands that are on their way.
struct Slot {
    std::map<std::string, StagedPlane> inputs, outputs;
    Rows rows;
    std::vector<cl::Event> downloads;
};

class StagedRun {
public:
    StagedRun(Pass::Impl& impl, const HostBytes& in, const HostByteOutputs& out, const StagedOptions& options)
        : impl_(impl),
          in_(in),
          out_(out),
          options_(options),
          up_(impl.device.context, impl.device.device),
          down_(impl.device.context, impl.device.device) {
        double bytes_of_pixel = 0;
        for (const std::string& name : impl.plan.input_memories) bytes_of_pixel += input_bytes(name);
        for (const std::string& name : impl.plan.output_memories)
            bytes_of_pixel += static_cast<double>(impl.output_bytes(name));
        const std::size_t pixels = options.band_pixels != 0
                                       ? options.band_pixels
                                       : staged_band_pixels(impl.device.info.memory, bytes_of_pixel);
        const std::size_t least = impl.plan.sums_over;
        rows_ = std::clamp<std::size_t>(pixels / impl.size.width / least * least, least, impl.size.height);
    }
    ~StagedRun() {
        try {  // nothing may be under way to memory that is about to go
            for (const cl::CommandQueue& queue : {up_, impl_.device.queue, down_}) queue.finish();
            for (const auto& [plane, memory] : mapped_) up_.enqueueUnmapMemObject(plane, memory);
            up_.finish();
        } catch (const cl::Error&) {
            // the device is gone, and what it did with it
        }
    }
    StagedRun(const StagedRun&) = delete;
    StagedRun& operator=(const StagedRun&) = delete;

    void run(const ToldShare& progress) {
        const std::size_t bands = (impl_.size.height + rows_ - 1) / rows_;
        for (Slot& slot : std::span(slots_).first(std::min(bands, kInFlight))) prepare(slot);
        for (std::size_t band = 0; band < bands + kInFlight; ++band) {
            if (band >= kInFlight && band - kInFlight < bands) {
                finish(slots_[band % kInFlight]);
                if (progress) progress(static_cast<double>(band - kInFlight + 1) / static_cast<double>(bands));
            }
            if (band < bands) begin(slots_[band % kInFlight], band * rows_);
        }
    }

private:
    double input_bytes(const std::string& name) const { return pixel_bytes(name, impl_.plan.formats); }

    StagedPlane plane_of(std::size_t pixels, std::size_t pixel_bytes) {
        const std::size_t bytes = padded(pixels) * pixel_bytes;
        StagedPlane plane{cl::Buffer(impl_.device.context, CL_MEM_READ_WRITE, bytes),
                          cl::Buffer(impl_.device.context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, bytes), nullptr,
                          pixel_bytes};
        void* memory = up_.enqueueMapBuffer(plane.host, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, bytes);
        mapped_.emplace_back(plane.host, memory);
        plane.memory = static_cast<std::byte*>(memory);
        return plane;
    }

    void prepare(Slot& slot) {
        const std::size_t halo = impl_.plan.neighbours ? 2 : 0, width = impl_.size.width;
        for (const std::string& name : impl_.plan.input_memories)
            slot.inputs.emplace(name, plane_of(width * (rows_ + halo), pixel_bytes(name, impl_.plan.formats)));
        for (const std::string& name : impl_.plan.output_memories)
            slot.outputs.emplace(name, plane_of(width * rows_, impl_.output_bytes(name)));
    }

    void delay(const cl::CommandQueue& queue, const std::vector<cl::Event>& wait) const {
        if (options_.delay) options_.delay(queue, wait);
    }

    /// Enqueues all of a band.
    void begin(Slot& slot, std::size_t first) {
        const std::size_t height = impl_.size.height, width = impl_.size.width;
        const std::size_t halo = impl_.plan.neighbours ? 1 : 0, count = std::min(rows_, height - first);
        const std::size_t before = std::min(halo, first), after = std::min(halo, height - first - count);
        slot.rows = {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                     static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(after)};
        std::vector<cl::Event> uploads;
        delay(up_, {});
        const auto upload = [&](const StagedPlane& plane, const std::byte* from, std::size_t rows) {
            const std::size_t bytes = rows * width * plane.pixel_bytes;
            std::memcpy(plane.memory, from, bytes);
            up_.enqueueWriteBuffer(plane.device, CL_FALSE, 0, bytes, plane.memory, nullptr, &uploads.emplace_back());
        };
        for (const auto& [name, plane] : slot.inputs)
            upload(plane, in_.at(name).data() + (first - before) * width * plane.pixel_bytes, before + count + after);
        for (const auto& [name, plane] : slot.outputs)
            if (has_gaps(name, impl_.plan.output_formats))
                upload(plane, out_.at(name).data() + first * width * plane.pixel_bytes, count);
        up_.flush();
        delay(impl_.device.queue, uploads);
        const std::vector<cl::Event> evaluated{
            impl_.enqueue(buffers(slot.inputs), buffers(slot.outputs), slot.rows, uploads)};
        impl_.device.queue.flush();
        slot.downloads.clear();
        delay(down_, evaluated);
        for (const auto& [name, plane] : slot.outputs)
            down_.enqueueReadBuffer(plane.device, CL_FALSE, 0, count * width * plane.pixel_bytes, plane.memory,
                                    &evaluated, &slot.downloads.emplace_back());
        down_.flush();
    }

    /// Waits for a band, and gives its results to the caller.
    void finish(Slot& slot) {
        cl::Event::waitForEvents(slot.downloads);
        const std::size_t width = impl_.size.width;
        for (const auto& [name, plane] : slot.outputs)
            std::memcpy(out_.at(name).data() + slot.rows.first * width * plane.pixel_bytes, plane.memory,
                        slot.rows.count * width * plane.pixel_bytes);
    }

    static DevicePlanes buffers(const std::map<std::string, StagedPlane>& planes) {
        DevicePlanes out;
        for (const auto& [name, plane] : planes) out.emplace(name, plane.device);
        return out;
    }

    Pass::Impl& impl_;
    const HostBytes& in_;
    const HostByteOutputs& out_;
    const StagedOptions& options_;
    cl::CommandQueue up_, down_;
    std::size_t rows_ = 0;
    std::array<Slot, kInFlight> slots_;
    std::vector<std::pair<cl::Buffer, void*>> mapped_;
};

}  // namespace

std::size_t staged_band_pixels(std::uint64_t memory, double bytes_of_pixel) {
    const double pixels = static_cast<double>(memory) / 16 / (kInFlight * std::max(bytes_of_pixel, 1.0));
    return static_cast<std::size_t>(
        std::clamp(pixels, static_cast<double>(kLeastPixels), static_cast<double>(kMostPixels)));
}

void run_staged(Pass::Impl& impl, const HostBytes& in, const HostByteOutputs& out, const ToldShare& progress,
                const StagedOptions& options) {
    StagedRun(impl, in, out, options).run(progress);
}

}  // namespace wrinkle
