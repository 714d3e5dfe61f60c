#pragma once

#include <cstdint>
#include <functional>

namespace wrinkle {

/// What is done with every band, one after the other.
struct BandStages {
    std::function<void(std::uint32_t band)> read, evaluate, write;
};

/// Brings bands 0 to `bands` - 1 through the three stages, each stage in the order of bands, one band at a time, and
/// beside the others as far as oneTBB has threads; on any thread. At most `in_flight` bands are begun and not yet
/// written, so band b may use what band b - in_flight has used.
///
/// Errors: what a stage throws first, once the others have finished the bands they are at.
void run_bands(std::uint32_t bands, std::uint32_t in_flight, const BandStages& stages);

}  // namespace wrinkle
