// bench/kernels: every file still builds with the current kernels, on every number of lanes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "device/program.h"
#include "tests/device/test_device.h"

namespace wrinkle::bench {
namespace {

TEST(BenchKernels, Build) {
    const Device& device = test::test_device();
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(WRINKLE_SOURCE_DIR "/bench/kernels")) {
        if (entry.path().extension() != ".cl") continue;  // .clh: a bump that a scene's kernel includes
        std::ifstream in(entry.path());
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        for (const int lanes : {1, 4, 8, 16})
            EXPECT_NO_THROW(build_program(device, text, {lanes, false})) << entry.path() << ", " << lanes << " lanes";
        ++files;
    }
    EXPECT_GE(files, 4u);
}

}  // namespace
}  // namespace wrinkle::bench
