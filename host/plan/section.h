#pragma once

#include <set>
#include <string>
#include <vector>

#include "plan/plan.h"

namespace wrinkle {

/// A value that one section hands on to later ones: a variable of a fused kernel, scratch planes between split kernels.
struct Value {
    const char* name;
    const char* type;
    std::vector<const char*> parts;  ///< members; {""} for a plain real
};

const std::vector<Value>& values();

/// A step of the evaluation as kernel text, with the values it reads and those it sets.
struct Section {
    std::string title;      ///< for people; it is not in the text, so that renaming a layer compiles nothing
    const char* kind = "";  ///< of a layer; a comment in the text names the section by it
    std::string body;
    std::set<std::string> reads, writes;
    std::set<std::string> inputs;  ///< planes
    std::vector<std::string> outputs;
    double operations = 0;
    int stage = 0;
    bool summed = false;                  ///< what it writes is then taken as the mean over each pixel of the picture
    std::vector<SectionSummary> parts{};  ///< what `explain` lists; empty: the section itself
    bool area =
        false;  ///< a layer whose body is evaluated at several points of a pixel's area; it has, before the first:
    std::string wanted;  ///< ... the name of the mask that is true where the layer is wanted
    std::string masks;   ///< ... its declarations, and the mask as far as it comes from planes
    std::string before;  ///< ... then its statements, where the shares of the area are known
};

/// What emitters share while a plan grows.
struct Emitter {
    LayerKinds kinds;
    const Scene& scene;
    const Available& available;
    const PlanOptions& options;
    Plan plan;
    std::string helpers;  ///< functions that precede the kernels
    /// The user's own kernel text by its file, and the structures of parameters that precede it, by the function that
    /// takes them.
    std::map<std::string, std::string> user_files{}, user_parameters{};

    /// The variant that a layer of the scene is to have.
    Precision precision(const Layer& layer) const;
    Precision geometry_precision() const;
    /// Number of a texture in the table; equal uses share one.
    std::size_t texture(const TextureUse& use, TexelKind kind);
    /// Number of a volume in the same table.
    std::size_t volume(const VolumeLayer& layer, TexelKind kind);
    /// Index of the first of several numbers of a layer; `what` names them in messages.
    std::size_t numbers(const Layer& layer, const std::string& what,
                        std::function<std::vector<double>(const Layer&, const NumberSource&)> of);
    /// Kernel text of one number of a layer, or of three as a vector.
    std::string number(const Layer& layer, const std::string& what, std::function<double(const Layer&)> of);
    std::string vector(const Layer& layer, const std::string& what, std::function<Vec3(const Layer&)> of);
    /// Index of a group of four numbers of a layer that change with the eye.
    std::size_t eye_place(const Layer& layer, std::function<EyePlace(const Layer&)> of);
    /// The layer's place in the scene.
    std::size_t index_of(const Layer& layer) const { return static_cast<std::size_t>(&layer - scene.layers.data()); }
    const LayerKind& kind(const Layer& layer) const { return kind_of(kinds, layer); }
    /// Throws unless every plane is there; `who` starts the message.
    void need(const std::string& who, const std::vector<std::string>& planes) const;
    bool has(const std::string& plane) const { return available.planes.contains(plane); }
};

/// Hash of a Cryptomatte name: one that is known, or "#" and the hash as 8 hex digits. Throws Error, which begins with
/// `who` and lists the known names, when it is neither.
std::uint32_t cryptomatte_hash(const std::map<std::string, std::uint32_t>& known, const std::string& name,
                               const std::string& who);
/// Name of a plane as an identifier; different planes have different ones.
std::string identifier(const std::string& plane);

/// Where a layer comes from and its name, to start a message: scene.toml:12: layer "dents".
std::string layer_label(const Layer& layer);
/// Where a row of a table comes from: decals.csv:12. Rows of files without lines, and of code, are told by their
/// number.
std::string row_place(const DecalsLayer& table, std::size_t row);

/// The section of one layer, or of several that share a loop.
///   space   a layer before them in the stage adds to dh_dp
Section emit_layers(Emitter& emitter, const std::vector<const Layer*>& layers, bool space);
/// How many layers from `first` on go into one section.
std::size_t layers_together(LayerKinds kinds, const std::vector<Layer>& layers, std::size_t first);
/// Kernel text that sets `m`, in [0,1], and `active`, in two parts: the factors that come from planes, which hold for
/// the whole pixel, and the rest.
struct MaskText {
    std::string planes;  ///< declares m
    std::string rest;    ///< goes on with m, and declares active
    bool everywhere;     ///< no plane tells where the mask is 0, so the layer may be anywhere
};
MaskText emit_mask_parts(Emitter& emitter, const Layer& layer, Section& section);
/// Kernel text that declares `wanted`: true wherever one of the layers may be, as far as planes tell of their masks.
/// Empty where one of them may be anywhere.
std::string emit_wanted(Emitter& emitter, const std::vector<const Layer*>& layers, Section& section);
/// Gets one of a layer's mappings: that of its texture, or that of its mask's.
using UvOf = std::function<const UvMapping&(const Layer&)>;
/// Kernel text that declares the texture coordinates `c` of a mapping.
std::string emit_texcoord(Emitter& emitter, const Layer& layer, const UvOf& uv_of, Wrap wrap, const std::string& who,
                          Section& section);
/// Decodes the G-buffer: sets valid, marked, p, n, and those of the values `wanted` that planes give. `mapped` are the
/// layers that use texture coordinates.
Section emit_decode(Emitter& emitter, const std::set<std::string>& wanted, const std::vector<const Layer*>& mapped);
/// Kernel text that declares `dh`, the change of a height plane per pixel. Where no neighbour is on the same surface,
/// it is 0 and the pixel is marked.
std::string emit_height_taps(Emitter& emitter, const std::string& plane, Section& section);
/// The kernel that measures the tiles of the frame, for the bins of decals and lights.
PlannedKernel emit_tiles(Emitter& emitter, std::string& source);
/// The kernels that bin decals and lights; gives the one that measures tiles, which reads planes.
PlannedKernel emit_bins(Emitter& emitter, std::string& source);
/// Kernel text that sets dp_dx and dp_dy, from p and n. `along` is text of r in p = r d, where d is the pixel's ray.
std::string derivative_text(const Emitter& emitter, const std::string& along = "wr_along_ray(p, d)");
/// Kernel text that turns n towards the viewer, and declares `away`: true where it faced away.
std::string face_viewer_text(const Emitter& emitter);
/// How a stage ends.
struct StageEnd {
    bool surface = false, volume = false;  ///< layers add to g, to dh_dp
    bool turns = false;                    ///< layers turn n themselves
    bool more = false;                     ///< another stage follows; only then are derivatives wanted
    bool derivatives = false;              ///< dp_dx and dp_dy are those of this stage's n
    bool wants_derivatives = false;        ///< dp_dx and dp_dy of the bumped surface are wanted
};
/// Projects, resolves, and sets up the next stage if there is one.
Section emit_resolve(Emitter& emitter, const StageEnd& stage);
/// What a section over pixels' areas computes beside the mean gradients.
struct AreaUse {
    bool spread = false;  ///< the covariance of the slopes
    bool lights = false;  ///< the light on every point, which needs that covariance; a later such section lights anew
                          ///< the pixels that it bends
    bool first = true;    ///< no such section comes before
    bool space = false;   ///< a layer of the stage, of this section or before it, adds to dh_dp
};
/// Joins consecutive sections into one that evaluates them at several points of a pixel's area, and sets g and dh_dp to
/// the means.
Section emit_area(Emitter& emitter, const std::vector<Section>& sections, const AreaUse& use);
/// Whether layers are evaluated over pixels' areas: at several points, or at one with the spread around it.
bool walks_area(const Emitter& emitter);
/// Kernel text that declares dp_dx and dp_dy, and uv if that is wanted, over a point's share of a pixel's area.
///   tap, shift   text of the point's number, and of its place (wr_tap_at)
std::string share_text(bool uv, const std::string& tap, const std::string& shift);
/// Kernel text that declares `taps`: the long axis of the pixel's area, and one point on it.
std::string axis_text(const Emitter& emitter);
/// Whether a layer is evaluated over pixels' areas. A table of decals is not if a parallax before it moves points: the
/// boxes of its tiles would have to cover where each point of the area is moved.
bool varies_over_area(const Emitter& emitter, const Layer& layer);
/// Whether a scene wants to know how the slopes vary over a pixel.
bool wants_spread(const Emitter& emitter);
/// Whether what is written of that also holds how the base normal turns within a pixel.
bool spreads_by_curvature(const Emitter& emitter);
/// The covariance of the slopes by which the base normal turns within a pixel.
Section emit_curvature();

/// Whether the lighting has a table of lights.
bool has_light_table(const Emitter& emitter);

/// Whether lights of the scene have an extent, for which kernels are compiled.
bool lights_extend(const Emitter& emitter);
/// Whether surfaces mirror skies of the scene, for which kernels are compiled.
bool mirrors_sky(const Emitter& emitter);
/// Adds the function to the plan's helpers that gives what surfaces mirror of the scene's skies, if there are some.
void add_mirrored_skies(Emitter& emitter);
/// The text of its call, with {n} and {roughness} for what stands there.
inline constexpr const char* kMirroredSkies =
    "wr_mirrored_skies({n}, base, v, {roughness}, lighting->f0, texels, textures, numbers)";
/// Whether metal of the scene is relit by what its own picture shows, for which kernels are compiled.
bool relights_metal(const Emitter& emitter);
/// Adds the function to the plan's helpers that gives what the scene's metals mirror, if there are some.
void add_metals(Emitter& emitter);
/// The text of its call, with {n} for what stands there; it takes `metal_object`.
inline constexpr const char* kMirroredByMetal = "wr_mirrored_by_metal({n}, base, v, metal_object, numbers)";
/// Text that declares `metal_object`, the number of the pixel's object.
std::string metal_object_text(Emitter& emitter, Section& section);
/// Lights that a pixel is expected to have: all without a table, and a few of it.
double lights_of_pixel(const Emitter& emitter);
/// What is known when the lighting is reached.
struct LightEnd {
    bool at_taps = false;  ///< every term of the light is its mean over the points of the pixel's area
    bool spread = false;   ///< the covariance of the slopes is known
    bool summed = false;   ///< every term, new and old, is its mean over a pixel of the picture
};
/// Whether a picture is relit that has fewer pixels than the frame: by the sums of the light on the pixels of each.
bool sums_light(const Emitter& emitter);
/// The terms of the light, with and without bumps, to be added up.
Section emit_light_terms(Emitter& emitter, const LightEnd& end);
Section emit_lighting(Emitter& emitter, const LightEnd& end);
/// A radiance that lighting needs of every normal: the value that holds it, and the text that computes it from
/// `lit_point` (lit_point_text), with {n} and {roughness} for what stands there.
struct LitTerm {
    std::string value, call;

    std::string of(const std::string& n, const std::string& roughness) const;
};
std::vector<LitTerm> lit_terms(const Emitter& emitter);
/// Kernel text that declares v, albedo and roughness of the pixel, `lit_point`, and what lit_terms read of a table of
/// lights.
std::string lit_surface_text(Emitter& emitter, Section& section);
/// Kernel text that gives `lit_point` a normal and a roughness.
std::string lit_point_text(const std::string& n, const std::string& roughness);
/// Kernel text that declares roughness alone.
std::string roughness_text(Emitter& emitter, Section& section);
/// Stores what the scene wants written.
Section emit_output(Emitter& emitter, bool bumped);

}  // namespace wrinkle
