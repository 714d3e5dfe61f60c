#pragma once

#include <fmt/format.h>

#include "wrinkle/device.h"
#include "wrinkle/error.h"

namespace wrinkle {

/// Does `work`; turns what OpenCL throws into an Error that says what was being done.
template <class Work>
auto guarded(const char* what, Work work) {
    try {
        return work();
    } catch (const cl::Error& error) {
        throw Error(fmt::format("{}: OpenCL reports {} ({})", what, error.what(), error.err()));
    }
}

}  // namespace wrinkle
