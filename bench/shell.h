#pragma once

#include <cstdlib>
#include <string>

#include "wrinkle/error.h"

namespace wrinkle::bench {

/// Runs a command line; what it prints goes nowhere unless it says where. Throws Error where it fails.
inline void call(const std::string& command) {
    if (std::system(("{ " + command + "; } >/dev/null").c_str()) != 0) throw Error("this command failed: " + command);
}

}  // namespace wrinkle::bench
