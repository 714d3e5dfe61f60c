// Which device is taken, and what is said of drivers that do not load.
#include "device/choose_device.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "device/drivers.h"
#include "wrinkle/error.h"

namespace wrinkle::test {
namespace {

DeviceInfo device(const char* type, const char* name, unsigned units, int lanes) {
    DeviceInfo info;
    info.platform = "Portable Computing Language", info.name = name, info.version = "OpenCL 3.0 PoCL HSTR",
    info.type = type;
    info.compute_units = units, info.lanes = lanes;
    return info;
}

TEST(ChooseDevice, TakesAGpuElseTheWidestCpu) {
    const std::vector<DeviceInfo> cpus{device("cpu", "small", 2, 8), device("cpu", "large", 8, 16),
                                       device("accelerator", "odd", 999, 16)};
    EXPECT_EQ(choose_device(cpus, "", 0), 1u);
    std::vector<DeviceInfo> all = cpus;
    all.push_back(device("gpu", "card", 1, 1));
    EXPECT_EQ(choose_device(all, "", 0), 3u);
    EXPECT_EQ(choose_device(std::span(cpus).last(1), ""), 0u);
}

TEST(ChooseDevice, TakesNoCpuForFasterThanTheProcessorsThatItHas) {
    const std::vector<DeviceInfo> two{device("cpu", "llvmpipe", 8, 4), device("cpu", "pocl", 2, 8)};
    EXPECT_EQ(choose_device(two, "", 2), 1u);   // 2 x 4 and 2 x 8
    EXPECT_EQ(choose_device(two, "", 64), 0u);  // 8 x 4 and 2 x 8
    const std::vector<DeviceInfo> equal{device("cpu", "a", 2, 8), device("cpu", "b", 4, 8)};
    EXPECT_EQ(choose_device(equal, "", 2), 0u);
}

TEST(ChooseDevice, ByNumberTypeNamePlatformOrVersion) {
    const std::vector<DeviceInfo> all{device("cpu", "AMD EPYC 9654", 2, 8), device("gpu", "Radeon 9", 8, 1)};
    EXPECT_EQ(choose_device(all, "1"), 1u);
    EXPECT_EQ(choose_device(all, "gpu"), 1u);
    EXPECT_EQ(choose_device(all, "radeon"), 1u);
    EXPECT_EQ(choose_device(all, "PoCL"), 0u);
    EXPECT_EQ(choose_device(all, "portable"), 0u);
    for (const char* wanted : {"9654", "2", "x", "nvidia"}) {
        try {
            choose_device(all, wanted);
            ADD_FAILURE() << wanted;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("1: Radeon 9 (gpu"), std::string::npos) << error.what();
        }
    }
}

TEST(Drivers, ThatDoNotLoadAreToldWithTheReason) {
    const auto folder = std::filesystem::temp_directory_path() / fmt::format("wrinkle_drivers_{}", ::getpid());
    std::filesystem::create_directory(folder);
    std::ofstream(folder / "gone.icd") << "libOpenCLgone.so\n";
    std::ofstream(folder / "fine.icd") << "libc.so.6\n";
    std::ofstream(folder / "note.txt") << "libOpenCLgone.so\n";
    const std::vector<std::string> broken = broken_drivers(folder);
    std::filesystem::remove_all(folder);
    ASSERT_EQ(broken.size(), 1u);
    EXPECT_NE(broken.front().find("gone.icd: libOpenCLgone.so: cannot open"), std::string::npos) << broken.front();
    EXPECT_TRUE(broken_drivers(folder).empty());
}

}  // namespace
}  // namespace wrinkle::test
