#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scene/layer_kind.h"
#include "wrinkle/camera.h"
#include "wrinkle/plane_format.h"
#include "wrinkle/precision.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// How a camera's pixels become positions.
enum class CameraKind : int {
    pinhole,   ///< one eye point; the pinhole form of the screen derivatives
    parallel,  ///< no eye point; the general 4x4 form
    general,   ///< anything else; the general form, positions from planes
};

CameraKind camera_kind(const Camera& camera, Size size);

/// What a plan must know of a volume.
struct VolumeFacts {
    bool vectors = false;
    Mat4 index_from_world{};
};

/// What a plan may count on.
struct Available {
    std::set<std::string> planes;  ///< names as in wrinkle/gbuffer.h
    CameraKind camera = CameraKind::pinhole;
    bool ray_depth = false;                            ///< the depth plane holds distances along rays
    std::uint16_t beauty_scale = 1;                    ///< pixels along each side of a pixel of the picture
    std::map<std::string, std::uint32_t> cryptomatte;  ///< hashes of the known object names
    std::map<std::pair<std::string, std::string>, VolumeFacts> volumes{};  ///< by file and grid, as the scene has them
    PlaneFormats formats{};                                                ///< of planes that are not one float a pixel
    DeviceDepth device_depth = DeviceDepth::none;
};

/// What is wanted of a plan beyond the scene.
struct PlanOptions {
    bool split = false;  ///< one kernel a section, through memory, instead of one fused kernel: to test and to compare
    bool normal = true;  ///< there is a base normal
    bool write_normal = true;      ///< resolve and write it
    bool volume_gradient = false;  ///< write the sum of the volume gradients before any projection (accumulate_decals)
    bool view_footprint = false;   ///< no normal: footprints of a surface that faces the viewer
    Precisions precision{};
    PlaneFormats output_formats{};  ///< of outputs that are not one float a pixel
    // Savings, which the benchmark switches off to measure what they are worth:
    bool skip = true;               ///< groups of pixels that do not want a layer, or lie outside a decal, skip it
    bool switches = false;          ///< branch at run time around every layer; those of scale 0 are switched off
    bool compiled_numbers = false;  ///< the scene's numbers are part of the text, so that others need another program
};

/// Periods of three numbers: the same for all, or one each; 0 for none.
struct Periods : Vec3 {
    constexpr Periods(double all = 0) : Vec3{all, all, all} {}
    constexpr explicit Periods(const Vec3& each) : Vec3(each) {}
};

/// Three numbers that change with the eye: value_k = axes_k . eye + offset_k, reduced to [0, period_k) where there is a
/// period.
struct EyePlace {
    std::array<Vec3, 3> axes{};
    Vec3 offset{};
    Periods period = 0;
    double fourth = 0;  ///< stored after the three: the frequency of an octave
    /// The buffer gets, in place of the four numbers, what rounding them to float loses: number - (float)number.
    bool low = false;
};

/// What numbers of a plan are taken from: any scene of the structure that was planned.
struct NumberSource {
    const Scene& scene;
    const std::map<std::string, std::uint32_t>& cryptomatte;  ///< hashes of the known object names
};

/// Numbers of a scene that kernels read from a buffer, so that changing them compiles nothing.
struct PlannedNumbers {
    std::string name;       ///< for people: "scale of layer \"dents\""
    std::size_t count = 0;  ///< of them, one after the other
    std::function<std::vector<double>(const NumberSource&)> of;
};
/// Evaluates them. Throws Error, naming them, unless they are as many as planned, and finite as floats.
std::vector<double> numbers_of(const PlannedNumbers& planned, const NumberSource& source);
using PlannedEyePlace = std::function<EyePlace(const NumberSource&)>;

/// A texture as kernels sample it.
enum class TexelKind {
    slope,
    lost_slopes,  ///< the covariance of the slopes that samples of `slope` average
    height,
    mask,
    vector,
    volume,
    volume_smooth,
    sky,   ///< as surfaces mirror it; without a file one of two colours
    lobes  ///< the table of GGX's lobes, of no file
};
struct PlannedTexture {
    TextureUse use;
    TexelKind kind = TexelKind::slope;
    std::string grid{};                        ///< of a volume
    std::array<double, 4> region{0, 0, 1, 1};  ///< of the image: s and t from, s and t to
    std::string layer{};                       ///< label of the first layer that uses it, for messages
    bool vectors = false;                      ///< that the kernel text takes the grid to hold
    bool levels = false;                       ///< coarser levels of the grid, too
    bool products = false;                     ///< and the products of the slopes that they average
};

/// A decal that is a layer of its own: every pixel is tested against it, without tiles.
struct PlannedDecal {
    std::size_t layer = 0;  ///< of the scene
    ProjectedImage image;
    Projector (*row)(const Layer&) = nullptr;
};

/// A table of projectors, binned to tiles, as kernels see it.
struct PlannedDecals {
    std::size_t layer = 0;  ///< of the scene
    std::shared_ptr<const std::vector<Projector>> rows;
    std::vector<std::uint32_t> order;    ///< of the rows in the device's table
    std::vector<ProjectedImage> images;  ///< of each row
    std::vector<std::uint32_t> hashes;   ///< Cryptomatte, of each row; empty where no row has one
    /// Sets these, but for the layer, to the rows of another scene of the same structure.
    std::function<void(PlannedDecals& table, const NumberSource& source)> take_rows;
};

/// One kernel: its planes in the order of its arguments, those that share a memory by its name. Scratch planes exist in
/// split plans only.
struct PlannedKernel {
    std::string name;
    std::vector<std::string> inputs, scratch, outputs;
    double operations = 0;  ///< expected per pixel, where nothing is skipped
};

/// What `wrinkle explain` says of a section.
struct SectionSummary {
    int stage = 0;
    std::string title;
    std::vector<std::string> planes;  ///< channels that it reads
    double operations = 0;            ///< expected per pixel, where nothing is skipped
};

/// A scene turned into kernel text: only the layers, channels, octaves and options that it needs.
struct Plan {
    std::string source;  ///< entry kernels; concept files are included by name
    std::vector<PlannedKernel> kernels;
    std::vector<std::string> inputs, outputs;  ///< planes
    /// Where they are: planes themselves, or what they share.
    std::vector<std::string> input_memories, output_memories;
    PlaneFormats formats, output_formats;  ///< of planes that are not one float a pixel
    std::vector<PlannedTexture> textures;
    std::vector<PlannedNumbers> numbers;
    std::vector<PlannedEyePlace> eye_places;
    std::vector<PlannedDecal> decals;  ///< in the order of the kernels' buffer
    std::vector<PlannedDecals> tables;
    std::size_t projectors = 0;          ///< rows of all tables together
    std::optional<PlannedKernel> tiles;  ///< measures the tiles that projectors and lights are binned to
    bool neighbours = false;             ///< reads pixels of the rows above and below
    bool blocks = false;                 ///< work-items may evaluate blocks of pixels instead of rows
    bool specular_apart = false;         ///< what the picture shows as specular is relit apart from the rest
    std::uint32_t sums_over = 1;         ///< pixels along each side of a pixel of the picture, whose light is added up
    std::vector<SectionSummary> sections;
    double bytes = 0;  ///< expected per pixel: memory of planes read and written once
    /// Rows of the lighting's table of lights, in the order of the device's table; nothing: it has none.
    std::optional<std::vector<std::uint32_t>> light_order;
};

/// Throws Error naming the layer and the planes it lacks.
Plan make_plan(LayerKinds kinds, const Scene& scene, const Available& available, const PlanOptions& options);

}  // namespace wrinkle
