#include <cstdlib>
#include <cstring>

#include "io/volume_child.h"
#include "io/volume_file.h"
#include "tests/fuzz/fuzz.h"
#include "wrinkle/limits.h"

namespace {

/// This program again, unless the environment names another.
std::filesystem::path reader() {
    const char* const named = std::getenv("WRINKLE_FUZZ_READER");
    return named != nullptr ? named : "/proc/self/exe";
}

}  // namespace

/// Comes before libFuzzer looks at the arguments: the process that reads a volume is this program too.
extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    if (*argc > 1 && std::strcmp((*argv)[1], wrinkle::io::kServeVolume) == 0)
        std::_Exit(wrinkle::io::serve_volume(*argc, *argv));
    return 0;
}

/// By a process of its own, which may crash; this one may not.
WRINKLE_HARNESS(vdb_fuzz)(const std::uint8_t* data, std::size_t size) {
    wrinkle::set_limits({.memory = 0, .sandbox = {}, .volume_reader = reader()});
    return wrinkle::fuzz::with_file(data, size, ".vdb",
                                    [](const std::filesystem::path& file) { wrinkle::load_volume(file, ""); });
}
