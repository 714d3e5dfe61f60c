#pragma once

#include <filesystem>
#include <string>

#include "wrinkle/device.h"

namespace wrinkle {

/// How a program came to be, for the table that `run` prints.
enum class BuildSource { compiled, disk };

struct BuiltProgram {
    cl::Program program;
    BuildSource source = BuildSource::compiled;
    std::filesystem::path cache_file;  ///< empty: no cache folder
    std::string key;                   ///< all that the program depends on
};

struct BuildOptions {
    int lanes = 1;
    bool fp64 = false;
};

/// The options that the compiler gets. Throws Error for numbers of lanes that kernels do not come in.
std::string build_flags(const BuildOptions& options);

/// Builds kernel text (with its #include lines) or takes it from the disk cache, whose key is the expanded source, the
/// options, the device, its driver and its platform. A damaged cache entry is built anew.
/// Throws Error with the compiler's log, file:line of the kernel file.
BuiltProgram build_program(const Device& device, const std::string& text, const BuildOptions& options);

/// Writes the program to its cache file, which appears when it is complete. Called after its kernels ran once, so that
/// what the driver compiles at the first call is in it too. A cache that cannot be written is no error.
void save_program(const BuiltProgram& built);

}  // namespace wrinkle
