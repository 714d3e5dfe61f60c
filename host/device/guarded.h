#pragma once

#include "base/only_errors.h"
#include "wrinkle/device.h"

namespace wrinkle {

/// only_errors() for work that calls OpenCL.
template <class Work>
decltype(auto) guarded(const char* what, Work work) {
    return only_errors(what, [&]() -> decltype(auto) {
        try {
            return work();
        } catch (const cl::Error& error) {
            throw Error(fmt::format("{}: OpenCL reports {} ({})", what, error.what(), error.err()));
        }
    });
}

}  // namespace wrinkle
