#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace wrinkle {

/// OpenCL drivers that are installed but cannot be loaded, each with the reason: the ICD loader passes them over in
/// silence. `folder` holds the files that name them, a line each.
std::vector<std::string> broken_drivers(const std::filesystem::path& folder);

/// The same of the folder that the loader reads: OCL_ICD_VENDORS, or /etc/OpenCL/vendors.
std::vector<std::string> broken_drivers();

}  // namespace wrinkle
