#pragma once

#include "error.h"
#include "frame.h"
#include "record.h"
#include "wrinkle/passes.h"

namespace wrinkle::baseline {
struct Image;
}

namespace wrinkle::bench {

/// At how many pixels the errors of scenes are measured, and the seed that draws them.
inline constexpr std::size_t kErrorSamples = 4096;
inline constexpr std::uint32_t kSeed = 20201021;

/// A built pass with its planes on the device.
struct Resident {
    Pass pass;
    PlaneBuffers in, out;

    Resident(const Device& device, const Scene& scene, const BenchFrame& frame, const PassOptions& options = {});
    Resident(const Device& device, Pass built, const BenchFrame& frame);
    void run() { pass.enqueue(in.planes(), out.planes()).wait(); }
    Normals normals(std::size_t pixels);
};

/// Expected of a pass per pixel: its operations when nothing is skipped, and its bytes when each plane is moved once.
double operations_of(Pass& pass);
double bytes_of(Pass& pass);

/// The measurement of a scene by one contender. Bytes and operations are those of `work`, the fused pass: what the
/// scene needs at least, whatever the contender does.
Measurement scene_measurement(const std::string& group, const std::string& name, const std::string& variant, int lanes,
                              const Timing& seconds, Pass& work, const Normals& normals,
                              const ReferenceSample& reference);

/// The textures of a scene as the baselines take them.
std::map<std::filesystem::path, baseline::Image> baseline_images(const Scene& scene);

}  // namespace wrinkle::bench
