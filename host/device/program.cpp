#include "device/program.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

#include "device/kernel_sources.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace fs = std::filesystem;

namespace {

/// FNV-1a, 64 bits, with two offsets for 128: names files, protects nothing.
std::string hash_name(const std::string& text) {
    std::uint64_t a = 0xcbf29ce484222325u, b = 0x84222325cbf29ce4u;
    for (const unsigned char c : text) {
        a = (a ^ c) * 0x100000001b3u;
        b = (b ^ (c + 0x9e)) * 0x100000001b3u;
    }
    return fmt::format("{:016x}{:016x}", a, b);
}

constexpr char kMagic[] = "wrinkle program 1\n";

/// A cache file: magic, hash of the binary, binary. Empty where it is missing or damaged.
std::vector<unsigned char> read_cached(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    const std::string content{std::istreambuf_iterator<char>(in), {}};
    const std::size_t header = sizeof kMagic - 1 + 32;
    if (content.size() <= header || !content.starts_with(kMagic)) return {};
    const std::string binary = content.substr(header);
    if (hash_name(binary) != content.substr(sizeof kMagic - 1, 32)) return {};
    return {binary.begin(), binary.end()};
}

}  // namespace

fs::path cache_folder() {
    if (const char* folder = std::getenv("WRINKLE_CACHE_DIR"); folder != nullptr && *folder != '\0') return folder;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
        return fs::path(cache) / "wrinkle";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".cache/wrinkle";
    return {};
}

BuiltProgram build_program(const Device& device, const std::string& text, const BuildOptions& options) {
    const std::string source = expand_includes(text, "evaluate.cl");
    const std::string flags =
        fmt::format("-cl-std=CL1.2 -D WR_LANES={}{}", options.lanes, options.fp64 ? " -D WR_FP64" : "");
    BuiltProgram built;
    if (const fs::path folder = cache_folder(); !folder.empty()) {
        const std::string key =
            fmt::format("{}\n{}\n{}\n{}\n{}", flags, device.info.name, device.info.version, device.info.driver, source);
        built.cache_file = folder / (hash_name(key) + ".program");
    }
    if (!built.cache_file.empty()) {
        if (std::vector<unsigned char> binary = read_cached(built.cache_file); !binary.empty()) {
            try {
                built.program = cl::Program(device.context, {device.device}, cl::Program::Binaries{std::move(binary)});
                built.program.build(device.device, flags.c_str());
                built.source = BuildSource::disk;
                return built;
            } catch (const cl::Error&) {
                // the driver does not take its own binary any more: build anew
            }
        }
    }
    built.program = cl::Program(device.context, source);
    try {
        built.program.build(device.device, flags.c_str());
    } catch (const cl::Error& error) {
        throw Error(fmt::format("kernel build failed ({}) on {}:\n{}", error.err(), device.info.name,
                                built.program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device)));
    }
    built.source = BuildSource::compiled;
    return built;
}

void save_program(const BuiltProgram& built) {
    if (built.cache_file.empty() || built.source == BuildSource::disk) return;
    try {
        const auto binaries = built.program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.empty() || binaries.front().empty()) return;
        const std::string binary(binaries.front().begin(), binaries.front().end());
        std::error_code ignored;
        fs::create_directories(built.cache_file.parent_path(), ignored);
        fs::path beside = built.cache_file;
        beside += fmt::format(".{}", ::getpid());
        {
            std::ofstream out(beside, std::ios::binary);
            out << kMagic << hash_name(binary) << binary;
            if (!out.flush()) {
                fs::remove(beside, ignored);
                return;
            }
        }
        fs::rename(beside, built.cache_file, ignored);
    } catch (const cl::Error&) {
        // a driver without binaries: the next start compiles again
    }
}

}  // namespace wrinkle
