#pragma once

#include <functional>

#include "run/pass_impl.h"

namespace wrinkle {

struct StagedOptions {
    std::size_t band_pixels = 0;  ///< 0: by the device's memory
    /// For tests, called before each upload, evaluation and download of a band is enqueued on the queue, where those
    /// wait for these events: what it enqueues there makes a queue slow that is not.
    std::function<void(const cl::CommandQueue&, const std::vector<cl::Event>&)> delay{};
};

/// Pixels of a band on a device of that memory: a sixteenth of it for all bands in flight, 65,536 at least and 4
/// million at most, which is more than a transfer needs to reach its speed.
std::size_t staged_band_pixels(std::uint64_t memory, double bytes_of_pixel);

/// The frame from and to host memory, for devices with a memory of their own: three bands are in flight, each in
/// buffers of the device and in memory of the host that the device copies from and to by itself (CL_MEM_ALLOC_HOST_PTR,
/// which drivers pin). Uploads and downloads have a queue each: while a band is evaluated, the next one is uploaded and
/// the one before is downloaded. Planes were checked. Blocks.
void run_staged(Pass::Impl& impl, const HostBytes& in, const HostByteOutputs& out, const ToldShare& progress,
                const StagedOptions& options = {});

}  // namespace wrinkle
