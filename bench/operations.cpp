#include "operations.h"

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "device/kernel_sources.h"
#include "temporary_folder.h"

namespace wrinkle::bench {

namespace {

struct Cost {
    const char* text;
    double operations;
};

// What to look for in LLVM's text: instructions, intrinsics, and OpenCL's functions, which are calls there.
constexpr Cost kCosts[] = {{" fadd ", 1},     {" fsub ", 1},         {" fmul ", 1},   {" fdiv ", 1},     {"@_Z3fma", 2},
                           {"@llvm.fma.", 2}, {"@llvm.fmuladd.", 2}, {"@_Z4sqrt", 1}, {"@llvm.sqrt.", 1}};

}  // namespace

double counted_operations(const std::string& source) {
    const TemporaryFolder folder;
    const auto in = folder.path() / "kernel.cl", out = folder.path() / "kernel.ll";
    std::ofstream(in) << expand_includes(source, "kernel.cl");
    const std::string command = fmt::format(
        "clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -DWR_LANES=1 -O2 -fno-slp-vectorize "
        "-fno-vectorize -mllvm -inline-threshold=1000000 -ffp-contract=on -w -S -emit-llvm '{}' -o '{}' 2>/dev/null",
        in.string(), out.string());
    if (std::system(command.c_str()) != 0) return 0;
    std::ifstream lines(out);
    double sum = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.find("!llvm.loop") != std::string::npos) return 0;
        if (line.starts_with("declare")) continue;
        for (const Cost& cost : kCosts)
            if (line.find(cost.text) != std::string::npos) sum += cost.operations;
    }
    return sum;
}

}  // namespace wrinkle::bench
