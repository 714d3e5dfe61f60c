#pragma once

#include <set>
#include <string>
#include <vector>

#include "plan/section.h"

namespace wrinkle {

/// Values that a kernel takes from the kernels before it, and hands on to those after it, through scratch planes.
struct Handed {
    std::set<std::string> loaded, stored;
    std::set<std::string> means{};  ///< of those loaded: their means over pixels of the picture
};

/// One kernel for consecutive sections, at the end of the plan's source.
PlannedKernel emit_kernel(Plan& plan, const std::string& name, const std::vector<const Section*>& sections,
                          const Handed& handed, bool compiled_numbers);

/// A kernel that takes the means of values over the size x size pixels that are one pixel of the picture.
PlannedKernel emit_means(Plan& plan, const std::set<std::string>& of, std::uint32_t size, bool compiled_numbers);

}  // namespace wrinkle
