#include "tests/fuzz/fuzz.h"
#include "wrinkle/lighting.h"

/// A picture of a sky, in rows or in tiles.
WRINKLE_HARNESS(sky_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".exr",
                                    [](const std::filesystem::path& file) { wrinkle::load_sky(file); });
}
