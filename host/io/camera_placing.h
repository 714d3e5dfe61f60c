#pragma once

#include "io/frame_window.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle::io {

/// The camera at an eye, with a field of view or a lens, for a picture of `display` pixels of that aspect. A lens fits
/// its sensor to the picture as Blender does: automatic to the longer side.
Camera camera_looking(const CameraSource::LookAt& at, Size display, double pixel_aspect);

/// A camera for the display window as one for the whole frame, overscan included.
Camera windowed(const Camera& camera, const FrameWindow& window, Size frame);

}  // namespace wrinkle::io
