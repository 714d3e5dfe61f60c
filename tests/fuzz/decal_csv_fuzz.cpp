#include "wrinkle/decal_layers.h"

#include "tests/fuzz/fuzz.h"

WRINKLE_HARNESS(decal_csv_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".csv",
                                    [](const std::filesystem::path& file) { wrinkle::load_decals(file, 3); });
}
