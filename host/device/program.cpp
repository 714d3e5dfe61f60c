#include "device/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "base/limits.h"
#include "device/build_log.h"
#include "device/kernel_sources.h"
#include "device/program_cache.h"
#include "wrinkle/error.h"

namespace wrinkle {

std::string build_flags(const BuildOptions& options) {
    if (const int n = options.lanes; n != 1 && n != 4 && n != 8 && n != 16)
        throw Error(fmt::format("a work-item has 1, 4, 8 or 16 lanes, not {}", n));
    return fmt::format("-cl-std=CL1.2 -D WR_LANES={}{}", options.lanes, options.fp64 ? " -D WR_FP64" : "");
}

namespace {

bool is_pocl(const Device& device) { return device.info.platform == "Portable Computing Language"; }

/// What is compiled in for the device beyond the options, whatever the program.
std::string device_flags(const Device& device) {
    std::string flags;
    if (is_pocl(device)) flags += " -D WR_POCL_BUILTINS";
    // Without it OpenCL lets 1 / x be wrong by 2.5 ulp and sqrt by 3, and the documented errors are for less.
    if ((device.device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0)
        flags += " -cl-fp32-correctly-rounded-divide-sqrt";
    return flags;
}

/// Compilers within drivers (LLVM) do not survive a lack of memory. The frames and scenes of the tests need up to 400
/// MB of addresses, most of them for the pools of the threads that compile.
void check_room_to_compile() {
    constexpr double wanted = 550e6;
    if (const double room = address_room(); room < wanted)
        throw Error(
            fmt::format("the limit of the process (ulimit -v) leaves {:.0f} MB of addresses; OpenCL's compilers "
                        "may take {:.0f} MB, and end the program without",
                        std::max(room, 0.0) / 1e6, wanted / 1e6));
}

/// Builds `program`. An exception that crosses PoCL leaves its program locked for ever, also for whoever releases it:
/// then the handle is forgotten.
void build(cl::Program& program, const Device& device, const std::string& flags) {
    try {
        program.build(device.device, flags.c_str());
    } catch (const std::bad_alloc&) {
        program() = nullptr;
        throw Error(fmt::format("out of memory while {} builds a kernel", device.info.name));
    }
}

}  // namespace

BuiltProgram build_program(const Device& device, const std::string& text, const BuildOptions& options) {
    // PoCL prints clang's warnings of vectors wider than the processor's registers, which no caller can do a thing
    // about.
    const std::string source = (is_pocl(device) ? "#pragma clang diagnostic ignored \"-Wpsabi\"\n" : "") +
                               expand_includes(text, "evaluate.cl");
    const std::string flags = build_flags(options) + device_flags(device);
    BuiltProgram built;
    const cl::Platform platform(device.device.getInfo<CL_DEVICE_PLATFORM>());
    built.key = fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}", flags, platform.getInfo<CL_PLATFORM_NAME>(),
                            platform.getInfo<CL_PLATFORM_VERSION>(), device.info.name, device.info.version,
                            device.info.driver, source);
    built.cache_file = cache_file(built.key);
    if (!built.cache_file.empty()) {
        if (std::vector<unsigned char> binary = read_program(built.cache_file, built.key); !binary.empty()) {
            try {
                built.program = cl::Program(device.context, {device.device}, cl::Program::Binaries{std::move(binary)});
                build(built.program, device, flags);
                built.source = BuildSource::disk;
                return built;
            } catch (const cl::Error&) {
                // the driver does not take its own binary any more: build anew
            }
        }
    }
    check_room_to_compile();
    built.program = cl::Program(device.context, source);
    try {
        build(built.program, device, flags);
    } catch (const cl::Error& error) {
        throw Error(fmt::format("kernel build failed ({}) on {}:\n{}", error.err(), device.info.name,
                                build_errors(built.program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device))));
    }
    built.source = BuildSource::compiled;
    return built;
}

void save_program(const BuiltProgram& built) {
    if (built.cache_file.empty() || built.source == BuildSource::disk) return;
    try {
        // A context made elsewhere may have several devices; the program was built for one.
        const auto binaries = built.program.getInfo<CL_PROGRAM_BINARIES>();
        const auto one = std::ranges::find_if(binaries, [](const auto& binary) { return !binary.empty(); });
        if (one != binaries.end()) write_program(built.cache_file, built.key, *one);
    } catch (const cl::Error&) {
        // a driver without binaries: the next start compiles again
    }
}

}  // namespace wrinkle
