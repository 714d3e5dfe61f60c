#pragma once

#include "wrinkle/camera.h"

namespace wrinkle {

/// Where the pixels of a frame lie in the picture that its camera is for. They are the display window and any overscan
/// around it, so x and y are 0 or less.
struct FrameWindow {
    int x = 0, y = 0;  ///< the frame's first pixel, seen from the first one of the display window
    Size display;      ///< the picture
};

}  // namespace wrinkle
