#pragma once

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// Tables of 1,000 to 100,000 lights with ranges such that 8 reach a pixel, beside 8 lights that reach everywhere, in
/// one race. Group "lights". `quick`: without the longest.
void measure_lights(const Device& device, Size size, bool quick, Run& run);

}  // namespace wrinkle::bench
