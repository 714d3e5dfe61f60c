#pragma once

#include <map>
#include <vector>

#include "baseline.h"
#include "layers.h"
#include "stack_job.h"

namespace wrinkle::baseline {

/// A scene of box decals, prepared for every way in which the benchmark writes it. The decals have no masks, footprints
/// or hard edges; the camera is a pinhole, and depth is planar.
class DecalStack {
public:
    /// Throws Unsupported for any other scene.
    DecalStack(const Scene& scene, Size size, const Camera& camera,
               const std::map<std::filesystem::path, Image>& textures);

    /// Writes the new normals, on all cores.
    void run(StackRows rows, const PlaneMap& planes, Planes out) const;

private:
    Size size_;
    StackJob job_{};
    std::vector<Slopes> textures_;
    std::vector<StackDecal> decals_;
};

/// The ways to write the stack that were compiled for this machine, by name.
std::map<std::string, StackRows> stack_forms();

}  // namespace wrinkle::baseline
