#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wrinkle/frame_source.h"
#include "wrinkle/layers.h"
#include "wrinkle/lighting.h"

/// A scene: what to read, which bump layers to add, what to write. Plain values that name files and hold numbers; of
/// the functions here only load_scene() and check() open files, and none uses OpenCL. data/scenes/README.md is the
/// reference of the TOML form, which load_scene() reads.
///
///     wrinkle::Scene scene;
///     scene.layers = {grain};
///     scene.output.half = true;  // 16-bit files
///
/// Threads: values, used as any other: read by several at once, or changed by one. load_scene() may be called by
/// several at once.
namespace [[gnu::visibility("default")]] wrinkle {

/// How a pixel's area is filtered.
struct Filter {
    /// Points of the pixel's area at which layers are evaluated, at most; 1: only its centre, as if the area were
    /// round.
    int taps = 16;
    bool light_mean = false;  ///< light falls on the mean normal, made rougher, instead of on every point
    bool curvature = false;   ///< roughness and covariance also show how the base normal turns within a pixel
};

/// How EXR files are compressed: 16 or 1 rows at a time without loss, lossy, or not at all.
enum class Compression { zip, zips, dwaa, none };

/// What channels with components are called.
enum class ChannelNames {
    layers,  ///< normal.X, which Nuke shows as a layer
    passes,  ///< N.x, as renderers call theirs
};

struct Output {
    bool roughness = false;         ///< the frame's or the scene's, as the bumps of a pixel's area widen it
    bool slope_covariance = false;  ///< of the bumps in a pixel's area, along the image's axes on the surface
    bool surface_gradient = false, dp_dx = false, dp_dy = false, marked = false;  ///< beside the normal
    bool layers = false;       ///< the surface gradient of each layer by itself
    bool condition = false;    ///< how the normal magnifies input errors; by render(), not by a pass (run/condition.h)
    bool passthrough = false;  ///< copy the channels and metadata of the input
    bool half = false;         ///< 16-bit floats
    bool beauty_size = false;  ///< the picture's, of all files, where it has fewer pixels; else of lit ones only
    int png = 8;               ///< bits of a channel, 8 or 16; 0: no PNGs
    std::vector<std::string> pictures{"normal", "lit", "before"};  ///< the PNGs that are wanted
    std::string name{};  ///< of EXR files, with a place for a frame number; "<picture>" in it: of all, each its own
    Compression compression = Compression::zip;
    ChannelNames channel_names = ChannelNames::layers;
};

/// How large an error of the normals may be, and how it is measured: a seeded sample of pixels is evaluated in double.
struct ErrorBudget {
    std::optional<double> max_error;  ///< degrees, of any sampled pixel; nothing: standard precision, not measured
    /// Degrees by which 99% of the sampled pixels may miss the mean over their areas: the fewest taps that keep it are
    /// taken, up to those of the filter. Nothing: all of the filter's.
    std::optional<double> max_area_error{};
    int sample = 4096;  ///< pixels
    int seed = 1;
};

struct Scene {
    std::filesystem::path file;  ///< empty for scenes made in code
    GBufferSource gbuffer;
    CameraSource camera;
    std::vector<Layer> layers;
    Lighting lighting;
    Filter filter;
    Output output;
    ErrorBudget budget;
};

/// Reads and checks a scene in full; relative paths are relative to the scene's folder.
/// Throws Error listing every problem as "file:line: what was found; what is allowed", nearest known key included.
Scene load_scene(const std::filesystem::path& file);

/// Checks a scene as load_scene() does one of a file: numbers out of range, axes that span nothing, values that are
/// none of their type, textures that are missing, rows of tables of decals, names that are not unique. Every pass does
/// so first. Where the frame comes from (gbuffer.file, camera) is left to those who open it. Throws Error listing every
/// problem: `"octaves" in layer "dents" must be a whole number from 1 to 16; found 0`.
void check(const Scene& scene);

}  // namespace wrinkle
