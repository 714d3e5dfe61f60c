#include "io/volume_file.h"

#include "tests/fuzz/fuzz.h"

WRINKLE_HARNESS(nvdb_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".nvdb",
                                    [](const std::filesystem::path& file) { wrinkle::load_volume(file, ""); });
}
