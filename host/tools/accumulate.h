#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

struct AccumulateOptions {
    std::filesystem::path file;  ///< an EXR, with a place for the number in a sequence
    std::vector<int> frames;     ///< empty: the scene's file as it is
    std::string device;          ///< as Device::open takes it
    int lanes = 0;               ///< pixels a work-item; 0: the device's choice
    /// The scene of a frame, where textures or tables differ from frame to frame.
    std::function<Scene(int frame)> scene_of_frame;
    /// The hash of all that goes into a frame's file; nothing: none is written.
    std::function<std::string(int frame)> provenance;
};

struct AccumulateReport {
    std::size_t layers = 0;  ///< that were accumulated
    bool normals = false;    ///< the frames have normals, and angle fades and footprints went by them
    std::vector<std::filesystem::path> files;
    std::vector<std::string> warnings;
};

/// Sums the volume gradients of a scene's decals and tables of decals, and writes volume_gradient.X .Y .Z, world space.
/// Other layers are left out. Needs positions, or depth and a camera; in bands, so that memory does not grow with the
/// frame. Throws Error; files appear when they are complete.
AccumulateReport accumulate(const Scene& scene, const AccumulateOptions& options);

}  // namespace wrinkle
