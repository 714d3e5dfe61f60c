#pragma once

#include <functional>
#include <string>
#include <vector>

#include "wrinkle/device.h"

/// What `wrinkle devices --check` asks of a device, and what it found.
namespace wrinkle::selftest {

/// One error beside what it may be.
struct Finding {
    std::string what;  ///< "normal"
    std::string unit;  ///< "degrees", "relative" ...
    double error = 0;  ///< the largest, or as `what` says; NaN: a result was not finite
    double bound = 0;  ///< documented
    bool good() const { return error <= bound; }
};

/// Throws Error where the device cannot do it at all.
struct Check {
    std::string name;  ///< "function resolve, fast"
    std::function<std::vector<Finding>(const Device&)> run;
    double seconds = 10;  ///< that it may take, with what the driver compiles
};

/// Buffers written, copied, mapped and read, of odd sizes at odd places: bytes that differ.
std::vector<Check> transfer_checks();
/// Work-groups of every size that the device takes: numbers that differ from those of another size.
std::vector<Check> launch_checks();
/// Fused kernels of whole scenes, against answers of the references.
std::vector<Check> scene_checks();
/// Every function of functions() in standard precision, or in the others that it has, against answers of the
/// references.
std::vector<Check> function_checks(bool standard);

/// All of these, what matters most first.
std::vector<Check> all_checks();

}  // namespace wrinkle::selftest
