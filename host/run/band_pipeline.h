#pragma once

#include <cstdint>
#include <functional>

namespace wrinkle {

/// What is done with every band, in this order.
struct BandStages {
    std::function<void(std::uint32_t band)> read, evaluate, write;
};

/// Brings bands 0 to `bands` - 1 through the three stages. Each stage takes the bands in order, one at a time, on any
/// thread, while the other stages work on other bands as far as oneTBB has threads. At most `in_flight` bands are begun
/// and not yet written, so band b may use the memory of band b - in_flight.
///
/// Errors: throws what a stage threw first, once the others have finished their bands.
void run_bands(std::uint32_t bands, std::uint32_t in_flight, const BandStages& stages);

}  // namespace wrinkle
