#include "device/drivers.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace wrinkle {

std::vector<std::string> broken_drivers(const std::filesystem::path& folder) {
    std::vector<std::string> broken;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
        if (entry.path().extension() != ".icd" || !entry.is_regular_file(none)) continue;
        std::ifstream file(entry.path());
        std::string library;
        if (!std::getline(file, library) || library.empty()) continue;
        // As the loader does it; it holds those that load for as long as the program runs.
        if (::dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL) != nullptr) continue;
        const char* reason = ::dlerror();
        broken.push_back(fmt::format("{}: {}", entry.path().string(), reason != nullptr ? reason : "does not load"));
    }
    std::ranges::sort(broken);
    return broken;
}

std::vector<std::string> broken_drivers() {
    const char* own = std::getenv("OCL_ICD_VENDORS");
    return broken_drivers(own != nullptr ? own : "/etc/OpenCL/vendors");
}

}  // namespace wrinkle
