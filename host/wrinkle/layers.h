#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "wrinkle/camera.h"
#include "wrinkle/decal_layers.h"
#include "wrinkle/noise_layer.h"
#include "wrinkle/textures.h"

/// Bump layers: what there is to add, where, how strongly. data/scenes/README.md lists the same as TOML.
///
///     wrinkle::Layer grain;
///     grain.name = "grain";
///     grain.bump = wrinkle::NoiseLayer{.frequency = 20, .octaves = 4};
///     grain.scale = 0.002;    // metres
///     grain.mask.object = {7};  // only on this object
///
/// Threads: values, used as any other: read by several at once, or changed by one.
namespace [[gnu::visibility("default")]] wrinkle {

// --- Layers that read a map -----------------------------------------------------------------------------------------

/// Where tangent and bitangent come from: the G-buffer's planes, as the renderer interpolated them (mikkTSpace), or the
/// derivatives of the texture coordinates; automatic takes the planes where they are there and fit the mapping.
enum class TangentSource { automatic, derived, planes };

/// How a bump joins those below it in its stage. Surface gradients add up; the others are what other programs do
/// [Mik20 4.2], across any unwraps.
enum class Combine { surface_gradient, whiteout, udn, rnm, linear };

/// Tangent-space normal map, TBN style: strength does not depend on the tiling [Mik20 3.2, 3.3].
struct NormalMapLayer {
    static constexpr const char* kind = "normal_map";
    TextureUse texture{.content = Content::normal};
    UvMapping uv{};
    TangentSource tangents = TangentSource::automatic;
    Combine combine = Combine::surface_gradient;
};

/// Normals in object or world space, as a bake of the whole surface gives them [Mik20 3.4].
struct ObjectNormalLayer {
    static constexpr const char* kind = "object_normal";
    TextureUse texture{.content = Content::object_normal};
    UvMapping uv{};
    std::array<Vec3, 3> channels{
        {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< where red, green and blue point, in object space
    std::array<Vec3, 3> object_to_world{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rows; may scale and mirror
};

/// Slopes of a height, scale dependent [Mikkelsen 2011, derivative maps].
struct DerivativeMapLayer {
    static constexpr const char* kind = "derivative_map";
    TextureUse texture{.content = Content::slope};
    UvMapping uv{};
    /// true: heights are in widths of the pixel's texel on the surface (of the texture, where slopes are per texture),
    /// so that slopes do not depend on the tiling; false: in metres.
    bool auto_scale = false;
};

/// Height map, scale dependent: scale is metres for a height of 1 [Mik20 3.5].
struct HeightMapLayer {
    static constexpr const char* kind = "height_map";
    TextureUse texture{};
    UvMapping uv{};
};

/// A height in metres that a channel of the G-buffer holds, differenced with neighbours on the same surface [Mik20 3.5,
/// listing 7].
struct HeightChannelLayer {
    static constexpr const char* kind = "height_channel";
    std::string channel{};
};

/// Where an object is: its point q is at translate + R (scale q), R turning about x, then y, then z.
struct Placement {
    Vec3 translate{}, rotate{}, scale{1, 1, 1};  ///< metres; radians; a negative factor mirrors
    bool operator==(const Placement&) const = default;
};

/// A picture's first row is its top in both; this is where (0,0) of texture space is.
enum class TextureOrigin { lower_left, upper_left };
enum class Handedness { left, right };
/// [Mik20 figure 5] Slopes projected onto the surface; slopes as they are (Perlin's perturbation); the first components
/// of the normals as they are (Geiss). The last two are there to compare with.
enum class TriplanarMode { surface_gradient, perlin, geiss };

// --- Triplanar projections ------------------------------------------------------------------------------------------

/// What one plane of a triplanar projection shows in place of the layer's texture: another texture, or noise in the
/// plane's two coordinates, in metres. The plane cuts its lattice a third of a cell deep: faces of cells lie elsewhere,
/// in octaves of twice the frequency as well.
struct PlaneSource {
    std::variant<TextureUse, NoiseLayer> content;
    double scale = 1;  ///< times the layer's
};

/// Three planar projections along the axes of the world or of an object, blended by the normal [Mik20 4.4].
struct TriplanarLayer {
    static constexpr const char* kind = "triplanar";
    TextureUse texture;                                  ///< of the planes that have no source of their own
    std::array<std::optional<PlaneSource>, 3> planes{};  ///< across x, y and z
    double tile = 1;                                     ///< metres per repeat of the texture
    double sharpness = 3;                                ///< exponent k of the weights, listing 14
    TextureOrigin origin = TextureOrigin::lower_left;
    Handedness handedness = Handedness::left;  ///< left: sampled with (z,y), (x,z), (x,y); right: -z for z
    TriplanarMode mode = TriplanarMode::surface_gradient;
    Placement transform{};  ///< tile is in the object's units; heights are in metres all the same
};

// --- Volumes, constants, parallax, the next stage -------------------------------------------------------------------

/// What a volume's value becomes before it is a height; t goes from 0 to 1 over a range of values.
enum class Remap {
    none,    ///< the value itself
    ramp,    ///< t, flat outside the range
    smooth,  ///< 3 t^2 - 2 t^3, flat outside the range
    wave,    ///< sin(2 pi t)
};

enum class VolumeFilter {
    linear,  ///< trilinear: exact at voxels; the gradient jumps from cell to cell
    smooth,  ///< quadratic B-spline: a continuous gradient, the values smoothed a little
};

/// A grid of an OpenVDB or NanoVDB file. Of values: heights everywhere in space. Of vectors: the volume gradient dh/dp
/// itself, world. Outside the grid nothing is bumped.
struct VolumeLayer {
    static constexpr const char* kind = "volume";
    std::filesystem::path file{};
    std::string grid{};  ///< empty: the only one of the file
    VolumeFilter filter = VolumeFilter::linear;
    Remap remap = Remap::none;
    std::array<double, 2> range{0, 1};
    Mat4 transform{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};  ///< after the file's own; affine
};

/// The same volume gradient everywhere: dh/dp, world.
struct ConstantLayer {
    static constexpr const char* kind = "constant";
    Vec3 gradient{};
};

/// Gradients that channels hold: dh/dp, of which the part tangent to the surface counts, so surface gradients are read
/// alike. The channels are the frame's, or those of another file of its size, such as `wrinkle decals` writes. Those
/// that are not the frame's, or not in world space, come to passes as the planes gradientN.x .y .z, in world space; N
/// is the layer's place in the scene, from 0.
struct GradientLayer {
    static constexpr const char* kind = "gradient";
    std::filesystem::path file{};         ///< may hold the patterns of a frame's name; empty: the frame itself
    std::string layer{};                  ///< whose X, Y and Z they are; empty: volume_gradient
    std::vector<std::string> channels{};  ///< three, instead of a layer
    bool camera_space = false;            ///< x to the right, y up, z towards the viewer; else world space
};

/// A bump of the user's own: a function in OpenCL C, over the types of kernels/ (kernels/sources/dual.clh has
/// arithmetic that differentiates). It is native code on a CPU: run nobody's but who you trust.
struct KernelLayer {
    static constexpr const char* kind = "kernel";
    std::filesystem::path file{};
    std::string function{};                      ///< wr_dual FUNCTION(wr_bump_point at, FUNCTION_parameters k)
    std::map<std::string, double> parameters{};  ///< members of k, in the order of their names
    bool over_uv = false;           ///< its gradient is along s and t of `uv`, instead of x, y and z of the world
    std::optional<UvMapping> uv{};  ///< gives it texture coordinates
};

enum class ParallaxMode { offset, march };  ///< one step [Welsh 2004], or a search for where the ray meets the heights

/// Moves the point that later layers see along the ray, to a height field over the surface [Mik20 4.3]. It bumps
/// nothing itself. `scale` is the depth: metres for a height of 1.
struct ParallaxLayer {
    static constexpr const char* kind = "parallax";
    TextureUse texture{};
    UvMapping uv{};
    ParallaxMode mode = ParallaxMode::march;
    int steps = 32, refine = 3;  ///< of the march
    double level = 0;            ///< the height that lies on the surface: 0 raises, 1 carves
    bool curved = false;         ///< move the normal as well, by those of the neighbours
};

/// Normalise here and start a new stage on the resolved normal [Mik20 4.6].
struct ResolveLayer {
    static constexpr const char* kind = "resolve";
};

// --- Masks: all that are given multiply -----------------------------------------------------------------------------

struct MaskTexture {
    std::filesystem::path file{};
    UvMapping uv{};
    std::string layer{};  ///< as those of a TextureUse
    std::vector<std::string> channels{};
};

struct Mask {
    std::vector<double> object;  ///< pixels whose object index is one of these
    /// Objects by name, by a pattern of names ("Rock*"; ? stands for one character), or by "#" and 8 hex digits of the
    /// hash; the mask is what they cover together.
    std::vector<std::string> cryptomatte;
    std::optional<std::string> channel;  ///< name of a channel of the G-buffer, used as it is
    std::optional<MaskTexture> texture;  ///< first channel of an image, [0,1]
    bool invert = false;                 ///< 1 - product
};

// --- A layer --------------------------------------------------------------------------------------------------------

enum class Blend { add, subtract };

struct Layer {
    std::string name;      ///< unique; "kind N" when the file gives none
    std::string location;  ///< "scene.toml:12" for messages; empty for layers made in code
    std::variant<NormalMapLayer, HeightMapLayer, HeightChannelLayer, TriplanarLayer, NoiseLayer, DecalLayer,
                 DecalsLayer, ConstantLayer, ResolveLayer, ObjectNormalLayer, DerivativeMapLayer, ParallaxLayer,
                 VolumeLayer, KernelLayer, GradientLayer>
        bump;
    double scale = 1;  ///< metres per unit of height; a plain factor for normal maps and constants
    Blend blend = Blend::add;
    bool footprint = true;  ///< clamp mips and octaves to the pixel's footprint
    bool project =
        true;  ///< of gradients in space only the part tangent to the surface; false: Perlin 1985, to compare
    Mask mask;

    const char* kind() const {
        return std::visit([](const auto& l) { return l.kind; }, bump);
    }
};

}  // namespace wrinkle
