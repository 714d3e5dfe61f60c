#pragma once

#include "wrinkle/scene.h"

namespace wrinkle {

/// The scene without what normals do not depend on; its output `marked` tells invalid pixels.
inline Scene normals_only(Scene scene) {
    scene.lighting = {};
    scene.output = {.marked = true};
    return scene;
}

}  // namespace wrinkle
