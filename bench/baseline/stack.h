#pragma once

#include <map>
#include <vector>

#include "baseline.h"
#include "layers.h"
#include "stack_job.h"

namespace wrinkle::baseline {

/// A scene of box decals without masks, footprints or hard edges over planar depth of a pinhole camera, prepared for
/// any of the ways to write it.
class DecalStack {
public:
    /// Throws Unsupported for any other scene.
    DecalStack(const Scene& scene, Size size, const Camera& camera,
               const std::map<std::filesystem::path, Image>& textures);

    /// New normals, on every core.
    void run(StackRows rows, const PlaneMap& planes, Planes out) const;

private:
    Size size_;
    StackJob job_{};
    std::vector<Slopes> textures_;
    std::vector<StackDecal> decals_;
};

/// Ways to write the stack that this build has, by name.
std::map<std::string, StackRows> stack_forms();

}  // namespace wrinkle::baseline
