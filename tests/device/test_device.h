// The device that tests run on.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "wrinkle/device.h"

namespace wrinkle::test {

/// WRINKLE_TEST_DEVICE, in any form that Device::open takes; what it takes by itself where that is not set.
inline std::string test_device_name() {
    const char* name = std::getenv("WRINKLE_TEST_DEVICE");
    return name != nullptr ? name : "";
}

/// Every test that opens a device opens this one, and none leaves programs in the user's cache.
inline const Device& test_device() {
    static const Device device = [] {
        const std::string folder = (std::filesystem::temp_directory_path() / "wrinkle_test_cache").string();
        ::setenv("WRINKLE_CACHE_DIR", folder.c_str(), 0);
        return Device::open(test_device_name());
    }();
    return device;
}

}  // namespace wrinkle::test
