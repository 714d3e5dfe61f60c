#pragma once

#include <set>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace wrinkle {

/// A value that sections hand on: a variable in a fused kernel, planes between split ones.
struct Value {
    const char* name;
    const char* type;
    std::vector<const char*> parts;  ///< members; {""} for a plain real
};

const std::vector<Value>& values();

/// A step of the evaluation as kernel text, with the values it reads and those it sets.
struct Section {
    std::string title;      ///< for people; names of layers stay out of the text, so that they compile nothing
    const char* kind = "";  ///< of a layer; what the text says of the section
    std::string body;
    std::set<std::string> reads, writes;
    std::set<std::string> inputs;  ///< planes
    std::vector<std::string> outputs;
    double operations = 0;
    int stage = 0;
    std::vector<SectionSummary> parts{};  ///< what people are told of; none: of the section itself
    bool area = false;     ///< a layer that varies over a pixel's area; its body is evaluated at points of it
    std::string wanted;    ///< of such a layer: the name of the lanes that want it
    std::string masks;     ///< ... what is declared for all points, and the mask by planes
    std::string prepared;  ///< ... and what is set then for all points
};

/// What emitters share while a plan grows.
struct Emitter {
    LayerKinds kinds;
    const Scene& scene;
    const Available& available;
    const PlanOptions& options;
    Plan plan;
    std::string helpers;  ///< functions that precede the kernels
    /// The user's own kernel text by the file that it is from, and what stands before it: a structure of parameters by
    /// the name of the function that takes it.
    std::map<std::string, std::string> user_files{}, user_parameters{};

    /// The variant that a layer of the scene is to have.
    Precision precision(const Layer& layer) const;
    Precision geometry_precision() const;
    /// Number of a texture in the table; the same use is stored once.
    std::size_t texture(const TextureUse& use, TexelKind kind);
    /// Number of a volume in the same table.
    std::size_t volume(const VolumeLayer& layer, TexelKind kind);
    /// Index of the first of several numbers of a layer; `what` they are, for people to read.
    std::size_t numbers(const Layer& layer, const std::string& what,
                        std::function<std::vector<double>(const Layer&, const NumberSource&)> of);
    /// Kernel text of one number of a layer, or of three as a vector.
    std::string number(const Layer& layer, const std::string& what, std::function<double(const Layer&)> of);
    std::string vector(const Layer& layer, const std::string& what, std::function<Vec3(const Layer&)> of);
    /// Index of the first of four numbers of a layer that follow the eye.
    std::size_t eye_place(const Layer& layer, std::function<EyePlace(const Layer&)> of);
    /// The layer's place in the scene.
    std::size_t index_of(const Layer& layer) const { return static_cast<std::size_t>(&layer - scene.layers.data()); }
    const LayerKind& kind(const Layer& layer) const { return kind_of(kinds, layer); }
    /// Throws unless every plane is there; `who` starts the message.
    void need(const std::string& who, const std::vector<std::string>& planes) const;
    bool has(const std::string& plane) const { return available.planes.contains(plane); }
};

/// Hash of a Cryptomatte name among those known, or of "#" and its 8 hex digits. Throws Error, `who` first, listing the
/// names, when there is no such.
std::uint32_t cryptomatte_hash(const std::map<std::string, std::uint32_t>& known, const std::string& name,
                               const std::string& who);
/// Name of a plane as an identifier; different planes have different ones.
std::string identifier(const std::string& plane);

/// Where a layer comes from and its name, to start a message: scene.toml:12: layer "dents".
std::string layer_label(const Layer& layer);
/// Where a row of a table comes from: decals.csv:12; of files without lines, and of rows made in code, its number.
std::string row_place(const DecalsLayer& table, std::size_t row);

/// Emits the layers that one section holds: a single one, or several that share a loop.
Section emit_layers(Emitter& emitter, const std::vector<const Layer*>& layers);
/// How many layers from `first` on go into one section.
std::size_t layers_together(LayerKinds kinds, const std::vector<Layer>& layers, std::size_t first);
/// Kernel text that sets `m`, in [0,1], and `active`, and the planes it reads.
std::string emit_mask(Emitter& emitter, const Layer& layer, Section& section);
/// The same in two parts: what planes say of it, which is the same for all of a pixel, and the rest.
struct MaskText {
    std::string planes;  ///< declares m
    std::string rest;    ///< goes on with m, and declares active
    bool everywhere;     ///< `planes` does not say where it is 0
};
MaskText emit_mask_parts(Emitter& emitter, const Layer& layer, Section& section);
/// Kernel text that declares `wanted`: true wherever one of the layers may be, by what planes say of their masks. No
/// text where a layer has no such mask and may be anywhere.
std::string emit_wanted(Emitter& emitter, const std::vector<const Layer*>& layers, Section& section);
/// The mapping that a layer's texture lies by; that of a mask's texture.
using UvOf = std::function<const UvMapping&(const Layer&)>;
/// Kernel text that declares the texture coordinates `c` of a mapping.
std::string emit_texcoord(Emitter& emitter, const Layer& layer, const UvOf& uv_of, Wrap wrap, const std::string& who,
                          Section& section);
/// Decodes the G-buffer: valid, marked, p, n and what else of `wanted` is needed; texture coordinates by `mapped`.
Section emit_decode(Emitter& emitter, const std::set<std::string>& wanted, const std::vector<const Layer*>& mapped);
/// Kernel text that declares `dh`, the change of a height plane from pixel to pixel, 0 and marked where there is none.
std::string emit_height_taps(Emitter& emitter, const std::string& plane, Section& section);
/// The kernel that measures the tiles of the frame, for the bins of decals.
PlannedKernel emit_tiles(Emitter& emitter, std::string& source);
/// The kernels that bin decals; gives the one that measures tiles, which reads planes.
PlannedKernel emit_bins(Emitter& emitter, std::string& source);
/// Kernel text that sets dp_dx and dp_dy of p and n; `along`: the factor r of p = r d, d the pixel's ray.
std::string derivative_text(const Emitter& emitter, const std::string& along = "wr_along_ray(p, d)");
/// Kernel text that turns n towards the viewer; `away` where it had to.
std::string face_viewer_text(const Emitter& emitter);
/// How a stage ends.
struct StageEnd {
    bool surface = false, volume = false;  ///< layers add to g, to dh_dp
    bool turns = false;                    ///< layers turn n themselves
    bool more = false;                     ///< another stage follows; only then are derivatives wanted
    bool derivatives = false;              ///< dp_dx and dp_dy are those of this stage's n
    bool wants_derivatives = false;        ///< those of the bent surface are wanted
};
/// Projects, resolves, and sets up the next stage if there is one.
Section emit_resolve(Emitter& emitter, const StageEnd& stage);
/// Layers over a pixel's area, and what is known of what follows.
struct AreaUse {
    bool spread = false;  ///< the covariance of the slopes is wanted
    bool lights = false;  ///< light falls on every point of the area; a later area does so anew where it bends
    bool first = true;    ///< no area is before it
};
/// One section for consecutive ones that vary over the area: evaluates them at several points of it, and sets g and
/// dh_dp to the means.
Section emit_area(Emitter& emitter, const std::vector<Section>& sections, const AreaUse& use);
/// Whether a scene's layers are evaluated at several points of a pixel, or their spread is wanted.
bool walks_area(const Emitter& emitter);
/// Kernel text that declares the long axis of the pixel's area, `taps`.
std::string axis_text(const Emitter& emitter);
/// Whether a layer is evaluated at several points of a pixel's area. A table of decals is not where a parallax before
/// it moves points: the tiles that it is binned to would have to know how far.
bool varies_over_area(const Emitter& emitter, const Layer& layer);
/// Whether a scene wants to know how the slopes vary over a pixel.
bool wants_spread(const Emitter& emitter);

/// What lighting is given.
struct LightEnd {
    bool at_taps = false;  ///< `lit` is there: the mean over the pixel's area
    bool spread = false;   ///< the covariance of the slopes is known
};
Section emit_lighting(Emitter& emitter, const LightEnd& end);
/// Kernel text that declares v, albedo and roughness of the pixel.
std::string lit_surface_text(Emitter& emitter, Section& section);
/// Kernel text that declares roughness alone.
std::string roughness_text(Emitter& emitter, Section& section);
/// Stores what the scene wants written.
Section emit_output(Emitter& emitter, bool bumped);

}  // namespace wrinkle
