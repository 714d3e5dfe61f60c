#pragma once

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Tables of decals of different lengths that cover as many pixels of the courtyard as often: the whole pass, its
/// binning alone, the host's part for a new camera, and plain C++ with the same lists; turn by turn. Group "decals".
/// `quick`: short tables only, without plain C++.
void measure_decals(const Device& device, Size size, bool quick, Run& run);

}  // namespace wrinkle::bench
