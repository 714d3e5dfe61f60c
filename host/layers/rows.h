#pragma once

#include "scene/layer_kind.h"

/// The rows of the kinds, one function a file of this folder: layers/noise.cpp defines layers::noise(). CMake declares
/// them, and lists them for kinds.cpp, by what files there are.
namespace wrinkle::layers {

#include "layer_rows.inc"

}  // namespace wrinkle::layers
