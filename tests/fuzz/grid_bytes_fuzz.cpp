#include "io/grid_bytes.h"
#include "tests/fuzz/fuzz.h"

/// What a process that a volume has damaged may hand over.
WRINKLE_HARNESS(grid_bytes_fuzz)(const std::uint8_t* data, std::size_t size) {
    try {
        wrinkle::io::unpack_grid({reinterpret_cast<const std::byte*>(data), size}, "fuzzed.vdb");
    } catch (const wrinkle::Error&) {}
    return 0;
}
