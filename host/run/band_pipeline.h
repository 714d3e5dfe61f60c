#pragma once

#include <cstdint>
#include <functional>

namespace wrinkle {

/// What is done with every band, in this order.
struct BandStages {
    std::function<void(std::uint32_t band)> read, evaluate, write;
};

/// Brings bands 0 to `bands` - 1 through the three stages. Each stage takes the bands in order, one at a time, while
/// the other stages work on other bands: `evaluate` on the caller's thread, the others on one each of their own. At
/// most `in_flight` bands are begun and not yet written, so band b may use the memory of band b - in_flight.
///
/// The threads are not those of a pool, as stages wait for devices. Intel's OpenCL runs kernels on oneTBB's threads,
/// of which a process has one less than cores: stages on those waited for kernels that waited for their threads.
///
/// Where there is no thread to be had, one stage after the other takes a band on the caller's. `in_flight` is 1 at
/// least.
///
/// Errors: throws what a stage threw first, once the others have finished their bands.
void run_bands(std::uint32_t bands, std::uint32_t in_flight, const BandStages& stages);

}  // namespace wrinkle
