#include <cstdlib>

#include "io/volume_file.h"
#include "tests/fuzz/fuzz.h"
#include "wrinkle/limits.h"

/// By the process that WRINKLE_FUZZ_READER names, which may crash; this one may not.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const char* const reader = std::getenv("WRINKLE_FUZZ_READER");
    if (reader == nullptr) std::abort();
    wrinkle::set_limits({.memory = 0, .sandbox = {}, .volume_reader = reader});
    return wrinkle::fuzz::with_file(data, size, ".vdb",
                                    [](const std::filesystem::path& file) { wrinkle::load_volume(file, ""); });
}
