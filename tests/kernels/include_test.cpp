// Anyone's program can include any of the kernel files: each brings what it needs and may come twice, on every number
// of lanes, in every precision, beside names of one's own.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "device/kernel_sources.h"
#include "tests/kernels/clang_complaints.h"
#include "tests/kernels/kernel_function.h"

namespace wrinkle::test {
namespace {

/// Names that engines use themselves, with another meaning than the kernels would give them.
const char* const kOwnNames =
    "typedef float3 vec3;\ntypedef float2 vec2;\ntypedef int mask;\ntypedef float real;\ntypedef uint index;\n"
    "typedef float4 floats;\ntypedef struct { vec3 eye; real width; } frame;\n";

std::vector<std::string> kernel_files() {
    std::vector<std::string> names;
    for (const KernelSource& source : embedded_kernel_sources())
        if (const std::string name = source.name; name.ends_with(".clh") || name.ends_with(".h")) names.push_back(name);
    return names;
}

class EveryKernelFile : public testing::TestWithParam<std::string> {};

TEST_P(EveryKernelFile, CompilesAloneAndTwice) {
    if (!has_clang()) GTEST_SKIP() << "clang was not found by cmake";
    const std::string text = fmt::format("{0}#include \"{1}\"\n#include \"{1}\"\n", kOwnNames, GetParam());
    for (const char* language : {"CL1.2", "CL3.0"})
        for (const char* lanes : {"", "-DWR_LANES=8", "-DWR_LANES=16", "-DWR_LANES=16 -DWR_POCL_BUILTINS"})
            for (const char* precision : {"", "-DWR_FP64"}) {
                const std::string flags = fmt::format("-Wall -Wextra -Wundef -Wno-unused-function -cl-std={} {} {}",
                                                      language, lanes, precision);
                EXPECT_EQ(clang_complaints(text, flags), "") << GetParam() << ", " << flags;
            }
}

INSTANTIATE_TEST_SUITE_P(Kernels, EveryKernelFile, testing::ValuesIn(kernel_files()), [](const auto& at) {
    std::string name = at.param;
    std::ranges::replace_if(
        name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    return name;
});

TEST(KernelFiles, AreAllBehindWrinkleClh) {
    std::set<std::string> listed{"wrinkle.clh"};
    std::istringstream lines(kernel_source("wrinkle.clh"));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("#include \"")) listed.insert(line.substr(10, line.rfind('"') - 10));
    const std::vector<std::string> files = kernel_files();
    EXPECT_EQ(listed, std::set<std::string>(files.begin(), files.end()));
}

/// Through the device's own compiler, from the folder, without anything of the host's.
TEST(KernelFiles, BuildFromTheFolderOnTheDevice) {
    const Device& device = test_device();
    const std::string text =
        std::string(kOwnNames) +
        "#include \"wrinkle.clh\"\n#include \"surface/gbuffer.clh\"\n"
        "kernel void own(global float *out) { vec3 v = 1; out[0] = v.x + wr_lane(wr_zero3().x, 0); }\n";
    for (const int lanes : lanes_to_try({1, 16})) {
        cl::Program program(device.context, text);
        const std::string flags =
            fmt::format("-cl-std=CL1.2 -D WR_LANES={} -I {}", lanes, WRINKLE_SOURCE_DIR "/kernels");
        EXPECT_NO_THROW(program.build(device.device, flags.c_str()))
            << program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device.device);
    }
}

}  // namespace
}  // namespace wrinkle::test
