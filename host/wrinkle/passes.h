#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "wrinkle/device.h"
#include "wrinkle/gbuffer.h"
#include "wrinkle/plane_format.h"
#include "wrinkle/precision.h"
#include "wrinkle/scene.h"

/// The three passes, callable with host memory or enqueued on the caller's own queue with the caller's buffers.
///
///     const wrinkle::Frame frame{size, camera, {"depth", "normal.x", "normal.y", "normal.z"}};
///     auto pass = wrinkle::evaluate(wrinkle::Device::open(), scene, frame);
///     pass.run({{"depth", depth}, {"normal.x", nx}, {"normal.y", ny}, {"normal.z", nz}},
///              {{"normal.x", out_x}, {"normal.y", out_y}, {"normal.z", out_z}});
///
/// tests/examples/ holds a whole program for each pass.
///
/// Memory: an output must not share memory with an input or another output, neither spans of the host nor buffers,
/// sub-buffers or memory lent to buffers on the device; inputs may share. Kernels read neighbours and count on it.
///
/// Threads: a Pass is for one thread at a time, as OpenCL lets only one set the arguments of a kernel. Different passes
/// may be made and run by different threads at once, on one Device or copies of it.
namespace [[gnu::visibility("default")]] wrinkle {

/// The frame that a pass is made for.
struct Frame {
    Size size;
    Camera camera;
    std::set<std::string> planes;  ///< what the caller can give; names as in wrinkle/gbuffer.h
    bool ray_depth = false;        ///< "depth" is the distance along the ray, not planar
    /// Pixels along each side of a pixel of the beauty, whose planes repeat it so often. Their light is added up before
    /// the picture is multiplied by ratios of it. Rows begin at multiples of it, and bands have whole ones.
    std::uint32_t beauty_scale = 1;
    std::map<std::string, std::uint32_t> cryptomatte{};  ///< hashes of names, for Cryptomatte masks
    PlaneFormats formats{};                              ///< of planes that are not one float a pixel
    DeviceDepth device_depth = DeviceDepth::none;        ///< "depth" is a depth buffer, no length in metres
};

using HostPlanes = std::map<std::string, std::span<const float>>;
using HostOutputs = std::map<std::string, std::span<float>>;
using HostDoubles = std::map<std::string, std::span<double>>;
using HostBytes = std::map<std::string, std::span<const std::byte>>;  ///< planes in any formats, by Pass::inputs()
using HostByteOutputs = std::map<std::string, std::span<std::byte>>;  ///< by Pass::outputs()
/// Each holds at least padded(pixels) floats, or pixels of another format, inputs of a band the rows before it on top
/// of that; what lies beyond `pixels` is overwritten. Outputs that use host memory (CL_MEM_USE_HOST_PTR) must be
/// aligned to one lane group, 128 bytes at most; planes in pixels together to 4 bytes.
using DevicePlanes = std::map<std::string, cl::Buffer>;

struct PassOptions {
    int lanes = 0;                  ///< pixels a work-item: 1, 4, 8 or 16; 0: the device's choice
    bool fp64 = false;              ///< evaluate in double, as a reference; outputs are double
    bool split = false;             ///< one kernel a layer through memory instead of one fused kernel, to compare
    Precisions precision{};         ///< of the geometry and the layers; not with fp64, which needs none
    PlaneFormats output_formats{};  ///< of outputs that are not one float a pixel; not with fp64
};

/// Rows of the frame held by device planes: rows [first, first + count), preceded by `before` rows that only serve as
/// neighbours, followed by `after` more.
struct Rows {
    std::uint32_t first = 0, count = 0, before = 0, after = 0;
};

/// A pass, built: planned, compiled or taken from the cache, its textures on the device. Movable, not copyable.
class Pass {
public:
    struct Impl;
    explicit Pass(std::unique_ptr<Impl> impl);
    Pass(Pass&&) noexcept;
    Pass& operator=(Pass&&) noexcept;
    ~Pass();

    const std::vector<std::string>& inputs() const;   ///< planes that it reads; those that share a memory by its name
    const std::vector<std::string>& outputs() const;  ///< planes that it writes, likewise
    double bytes_per_pixel() const;                   ///< expected: of all that it reads and writes
    bool needs_neighbours() const;  ///< a band of rows needs one more row on each side, where the frame has one

    /// The same pass for another frame's camera, of the same kind.
    void set_camera(const Camera& camera);

    /// The same pass with another scene's numbers: strengths, colours, lights, frequencies, object indices, names of
    /// Cryptomatte objects, rows of tables of decals. Nothing is planned, compiled or read from files, and the results
    /// are those of a pass made for that scene, bit by bit. What code is compiled for stays as it is: the kinds of
    /// layers, their choices, switches, files and octaves, which optional parts there are, whether a mapping or an
    /// object is turned at all; of tables of decals, which textures, regions and wraps they use, in order of first use,
    /// and whether any row has a mask.
    /// Throws Error naming the layer and the key that differ there, and what check() finds; the pass is then as before.
    void set_parameters(const Scene& scene);

    /// Whole frame from and to host memory, in bands of bounded size; blocks. Every plane holds size.width x
    /// size.height numbers. Throws Error when a plane is missing or too short, or an output overlaps another plane.
    void run(const HostPlanes& in, const HostOutputs& out);
    void run(const HostPlanes& in, const HostDoubles& out);  ///< for a pass built with fp64
    /// The same of planes in any formats; those without one are floats, and outputs of a pass with fp64 doubles. Bytes
    /// of an output's pixels that no plane lies in stay as they are.
    void run(const HostBytes& in, const HostByteOutputs& out);

    /// Enqueues the whole frame on the device's queue; `wait` first. The event is complete when the outputs are. Events
    /// of other queues have to be flushed there, or they never come. Throws Error when a plane is missing or too small,
    /// or an output shares memory with another plane.
    cl::Event enqueue(const DevicePlanes& in, const DevicePlanes& out, const std::vector<cl::Event>& wait = {});
    /// Enqueues rows of the frame.
    cl::Event enqueue(const DevicePlanes& in, const DevicePlanes& out, const Rows& rows,
                      const std::vector<cl::Event>& wait = {});

    Impl& impl() { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

/// The fused stack: every layer of the scene, its resolves, its lighting, what it wants written.
///   outputs: normal.x .y .z (world, unit) and, as scene.output and scene.lighting ask, surface_gradient.*, dp_dx.*,
///   dp_dy.* (metres per pixel right, down), layerN.* (the surface gradient of the layer at place N of the scene, from
///   0), roughness, slope_covariance.xx .xy .yy (along dp_dx and across it), marked (see Marked), lit.r .g .b (linear)
/// Throws Error naming the layer when planes, textures or names are missing.
Pass evaluate(const Device& device, const Scene& scene, const Frame& frame, const PassOptions& options = {});

/// Volume gradients of decals and tables of decals, accumulated with no normal at hand; [Mik20 4.5] projects them
/// later, onto any normal: g = volume_gradient - n (n . volume_gradient), then normalize(n - g). The angle fade needs a
/// normal and is left out; footprints are those of a surface that faces the viewer. The sum depends on the order only
/// by rounding.
///   inputs: depth or position.*    outputs: volume_gradient.x .y .z (world, metres per metre)
Pass accumulate_decals(const Device& device, std::span<const Layer> decals, const Frame& frame,
                       const PassOptions& options = {});

/// Screen derivatives of the surface position, analytically, without neighbours [Mik20 3.7, listing 10].
///   inputs: normal.*, depth or position.*    outputs: dp_dx.*, dp_dy.* (world, metres per pixel right and down)
Pass screen_derivatives(const Device& device, const Frame& frame, const PassOptions& options = {});

}  // namespace wrinkle
