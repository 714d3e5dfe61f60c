#include "io/npy_file.h"

#include "tests/fuzz/fuzz.h"

WRINKLE_HARNESS(npy_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".npy",
                                    [](const std::filesystem::path& file) { wrinkle::io::read_npy<float>(file); });
}
