#pragma once

#include <chrono>
#include <functional>

#include "device/program.h"
#include "plan/plan.h"
#include "resources/texture_store.h"
#include "resources/tile_bins.h"
#include "wrinkle/passes.h"

namespace wrinkle {

/// A built plan and what its kernels read besides planes.
struct [[gnu::visibility("hidden")]] Pass::Impl {
    Device device;
    Scene scene;  ///< the numbers are taken from it
    std::map<std::string, std::uint32_t> cryptomatte;
    Camera camera;
    Size size;
    CameraKind kind;
    DeviceDepth device_depth;
    Plan plan;
    PassOptions options;
    BuiltProgram built;
    std::vector<cl::Kernel> kernels;
    std::shared_ptr<const DeviceTextures> textures;
    cl::Buffer frame, numbers, eye_places, decals, light_setup, lights;
    TileBins bins, light_bins;        ///< of the plan's tables of decals, of its table of lights, if it has any
    std::vector<cl::Buffer> scratch;  ///< split plans: a frame each, in the order of scratch_names
    std::vector<std::string> scratch_names;
    std::vector<cl::Event> scratch_use;  ///< the evaluation that scratch belongs to until it is done
    double texture_seconds = 0, build_seconds = 0;
    bool saved = false;
    cl::Event first_run;  ///< of kernels that callers enqueued
    bool warm = false;    ///< the kernels ran before

    /// Textures come from the store, if there is one.
    Impl(const Device& device, const Scene& scene, const Frame& frame, const PassOptions& options,
         const PlanOptions& plan_options, TextureStore* store = nullptr);

    /// Work-items of a band: `lanes` pixels each, one after another from the band's first on, never in blocks.
    struct Items {
        std::size_t first = 0, count = 0;
    };

    void set_camera(const Camera& other);
    void set_parameters(const Scene& other);
    /// Makes a change of what the constants are computed from, and uploads them; when that throws, all is as it was.
    void change(const std::function<void()>& what);
    /// Computes the constants that depend on the camera and on the scene's numbers, and uploads them.
    void upload_constants();
    /// Bins for as many rows of tables as there are.
    void make_bins();
    /// Those that there are, in the order of the kernels' arguments.
    std::vector<TileBins*> tile_bins();
    /// Evaluates the rows, or only `some` of their work-items where any are given.
    cl::Event enqueue(const DevicePlanes& in, const DevicePlanes& out, const Rows& rows,
                      const std::vector<cl::Event>& wait, std::span<const Items> some = {});

    ~Impl();
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    /// Writes the program to the disk cache, once; after the first kernels ran.
    void save();
    /// The same for kernels that callers enqueue, and wait for themselves: does nothing until the first of them has
    /// completed.
    void save_if_complete();
    std::size_t bytes_per_output() const { return options.fp64 ? sizeof(double) : sizeof(float); }
    /// Bytes from pixel to pixel of one of the plan's output_memories.
    std::size_t output_bytes(const std::string& memory) const;
};

/// wrinkle::evaluate with textures from a store, for those who make several passes of a scene.
Pass evaluate(const Device& device, const Scene& scene, const Frame& frame, const PassOptions& options,
              TextureStore* store);

/// The same of decals alone: the pass writes volume_gradient.x .y .z, the sum of their volume gradients. A frame with
/// normals gives what evaluate() would add up; without normals it is what wrinkle::accumulate_decals() gives.
Pass accumulate_decals(const Device& device, const Scene& scene, const Frame& frame, const PassOptions& options,
                       TextureStore* store);

/// Pass::run() that says after every band which share is done. What `progress` throws ends it; the rest of the outputs
/// then holds what it held.
using ToldShare = std::function<void(double)>;
void run(Pass& pass, const HostPlanes& in, const HostOutputs& out, const ToldShare& progress);
void run(Pass& pass, const HostPlanes& in, const HostDoubles& out, const ToldShare& progress);
void run(Pass& pass, const HostBytes& in, const HostByteOutputs& out, const ToldShare& progress);

/// Throws Error unless the camera's projection tells what the numbers of its depth buffer stand for.
void check_device_depth(DeviceDepth device_depth, const Camera& camera, Size size);

/// Whether a pass for one frame serves another, once it has its camera.
bool same_shape(const Frame& a, const Frame& b);

/// The plan that a scene gets for a frame.
Plan plan_for(const Scene& scene, const Frame& frame, const PlanOptions& options);

}  // namespace wrinkle
