#pragma once

#include <cstdlib>
#include <string>

#include "wrinkle/error.h"

namespace wrinkle::bench {

/// Runs a command line and drops what it prints, unless it redirects that itself. Throws Error when it fails.
inline void call(const std::string& command) {
    if (std::system(("{ " + command + "; } >/dev/null").c_str()) != 0) throw Error("this command failed: " + command);
}

}  // namespace wrinkle::bench
