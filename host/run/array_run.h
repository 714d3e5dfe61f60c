#pragma once

#include "run/pass_impl.h"

namespace wrinkle {

/// Evaluates a frame from and to arrays of the host, which were checked, band after band. On a device with a memory of
/// its own three bands are in flight: while one is evaluated, the next is uploaded and the one before is downloaded.
/// Blocks.
void run_arrays(Pass::Impl& impl, const HostBytes& in, const HostByteOutputs& out, const ToldShare& progress);

}  // namespace wrinkle
