// The device that tests run on.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "wrinkle/device.h"

namespace wrinkle::test {

/// WRINKLE_TEST_DEVICE, in any form that Device::open takes; what it takes by itself where that is not set.
inline std::string test_device_name() {
    const char* name = std::getenv("WRINKLE_TEST_DEVICE");
    return name != nullptr ? name : "";
}

/// Every test that opens a device opens this one, and none leaves programs in the user's cache. It is never released:
/// at exit, what drivers keep for each thread is gone before (Oclgrind writes to it all the same).
inline const Device& test_device() {
    static const Device* const device = [] {
        const std::string folder = (std::filesystem::temp_directory_path() / "wrinkle_test_cache").string();
        ::setenv("WRINKLE_CACHE_DIR", folder.c_str(), 0);
        return new Device(Device::open(test_device_name()));
    }();
    return *device;
}

/// Of some numbers of lanes, those to test: those that WRINKLE_TEST_LANES names ("1", "1 4"), or all where it is not
/// set.
inline std::vector<int> lanes_to_try(const std::vector<int>& wanted = {1, 4, 8, 16}) {
    const char* named = std::getenv("WRINKLE_TEST_LANES");
    if (named == nullptr) return wanted;
    std::vector<int> lanes;
    bool known = false;
    std::istringstream words(named);
    for (int n = 0; words >> n;) {
        known |= n == 1 || n == 4 || n == 8 || n == 16;
        if (std::ranges::find(wanted, n) != wanted.end()) lanes.push_back(n);
    }
    if (!known) throw std::runtime_error("WRINKLE_TEST_LANES names none of 1, 4, 8 and 16, so nothing would be tested");
    return lanes;
}

/// Whether to test double: false, and true where the device has it.
inline std::vector<bool> precisions_to_try() {
    return test_device().info.fp64 ? std::vector<bool>{false, true} : std::vector<bool>{false};
}

}  // namespace wrinkle::test
