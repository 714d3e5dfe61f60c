#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "wrinkle/camera.h"

/// A scene: what to read, which bump layers to add, what to write. Value types; nothing here knows files or OpenCL.
/// data/scenes/README.md is the reference of the TOML form; load_scene() reads it.
///
///     wrinkle::Layer grain;
///     grain.name = "grain";
///     grain.bump = wrinkle::NoiseLayer{.frequency = 20, .octaves = 4};
///     grain.scale = 0.002;    // metres
///     grain.mask.object = 7;  // only on this object
///     wrinkle::Scene scene;
///     scene.layers = {grain};
namespace wrinkle {

// --- Textures ------------------------------------------------------------------------------------------------------

/// What the texels mean: heights in units of `scale`; tangent-space normals; slopes dh/du, dh/dv; normals in object or
/// world space.
enum class Content { height, normal, slope, object_normal };
/// How heights become slopes: [Mik20 listing 16] with isUpscaleHQ false or true; [Mik20 listing 7], three taps a pixel
/// apart, to compare with, of height maps that repeat only.
enum class Upscale { plain, smooth, taps };
enum class Wrap { repeat, clamp };
enum class Encoding { automatic, sign, unit };  ///< slopes as they are, or 2 texel - 1; automatic: by the file's format
enum class SlopeUnit { texel, texture, metre };  ///< what a slope of 1 rises over; metre: decals

struct TextureUse {
    std::filesystem::path file{};
    Content content = Content::height;
    Upscale upscale = Upscale::smooth;
    Wrap wrap = Wrap::repeat;
    bool y_down = false;  ///< `y = "-"`: green points down (DirectX), t slopes change sign; tangent normals and slopes
    Encoding encoding = Encoding::automatic;  ///< slopes only
    SlopeUnit unit = SlopeUnit::texel;        ///< slopes only
};

// --- Texture coordinates -------------------------------------------------------------------------------------------

enum class UvSource { aov, planar };

/// (s,t) = rotate(scale * (u,v), rotation) + offset. t up. `planar`: u = axis_u . p, v = axis_v . p, world metres.
struct UvMapping {
    UvSource source = UvSource::aov;
    std::array<double, 2> scale{1, 1}, offset{0, 0};
    double rotation = 0;  ///< radians, anticlockwise
    Vec3 axis_u{1, 0, 0}, axis_v{0, 1, 0};
};

// --- Masks: all that are given multiply ----------------------------------------------------------------------------

struct MaskTexture {
    std::filesystem::path file{};
    UvMapping uv{};
};

struct Mask {
    std::optional<double> object;  ///< pixels whose object index equals this
    std::optional<std::string>
        cryptomatte;                     ///< object name, or "#" and 8 hex digits of its hash; the coverage is the mask
    std::optional<std::string> channel;  ///< name of a channel of the G-buffer, used as it is
    std::optional<MaskTexture> texture;  ///< first channel of an image, [0,1]
    bool invert = false;                 ///< 1 - product
};

// --- Layers --------------------------------------------------------------------------------------------------------

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
    TangentSource frame = TangentSource::automatic;
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
    bool auto_scale = false;  ///< a height of 1 is as much as the pixel's texel is wide, instead of a metre
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

enum class NoiseType { perlin, perlin1985, simplex, worley };
enum class CellFeature { f1, f2, f2_f1 };  ///< distance to the nearest point, to the second nearest, their difference
enum class FractalKind { sum, turbulence, ridged };
enum class NoiseGradient { analytic, forward, central };  ///< exact, or by differences of values, to compare

/// What is composed with noise f: first the remap, then one of the others at most.
struct NoiseShape {
    std::optional<std::array<double, 2>> remap;       ///< brings the first to 0 and the second to 1
    std::optional<double> power;                      ///< f^power, 1 at least; 0 for f below 0
    std::optional<std::array<double, 2>> smoothstep;  ///< from 0 at the first to 1 at the second
    std::optional<double> bias;                       ///< what 1/2 becomes, in (0,1); f in [0,1]
};

/// Noise in world space, a fractal of octaves gain^i noise(frequency lacunarity^i p).
struct NoiseLayer {
    static constexpr const char* kind = "noise";
    double frequency = 1;  ///< lattice cells per metre of the first octave
    int octaves = 1;       ///< at most; those above the footprint's Nyquist frequency are not evaluated
    double lacunarity = 2, gain = 0.5;
    NoiseType type = NoiseType::perlin;
    CellFeature feature = CellFeature::f1;  ///< worley
    FractalKind fractal = FractalKind::sum;
    double offset = 1, feedback = 2;        ///< ridged: height of the ridges; weight of an octave on the next
    std::array<double, 3> period{0, 0, 0};  ///< simplex: whole cells of the first octave at which an axis repeats, or 0
    double rotation = 0;                    ///< simplex: radians by which gradients are turned, flow noise
    NoiseGradient gradient = NoiseGradient::analytic;
    NoiseShape shape{};
};

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

/// [Mik20 4.5, figure 6] The surface's own normal is bumped; or the projector's axis is, and the two normals are mixed,
/// as engines do, to compare with.
enum class DecalMode { surface_gradient, projector };

/// Oriented box projector [Mik20 4.5]. The image spans the box's x and y; it is projected along z.
struct DecalLayer {
    static constexpr const char* kind = "decal";
    TextureUse texture;
    Vec3 center{};
    Vec3 axis_x{1, 0, 0}, axis_y{0, 1, 0};  ///< made orthonormal; axis_z = axis_x x axis_y points at the projector
    Vec3 half_size{0.5, 0.5, 0.5};          ///< metres
    double falloff = 0.1;                   ///< share of the half size over which it fades to the box's faces, [0,1]
    std::array<double, 2> angle_fade{0.25, 0.5};  ///< cosine of normal to axis_z: 0 below the first, 1 above the second
    DecalMode mode = DecalMode::surface_gradient;
};

enum class ProjectorShape {
    box,     ///< projects along z
    sphere,  ///< the ellipsoid within the box; projects along z
    cone,    ///< a spot: apex in the middle of the box's +z face, base on its -z face; the image fans out from the apex
};
enum class ProjectorMode { add, replace };

/// One row of a table of decals.
struct Projector {
    ProjectorShape shape = ProjectorShape::box;
    std::uint32_t texture = 0;                 ///< into the layer's textures
    std::array<double, 4> region{0, 0, 1, 1};  ///< of that texture: s and t from, s and t to; whole texels
    Vec3 center{};                             ///< of the box, world
    Vec3 axis_x{1, 0, 0}, axis_y{0, 1, 0};     ///< as those of DecalLayer
    Vec3 half_size{0.5, 0.5, 0.5};             ///< metres; 0 or less: touches nothing
    double scale = 1;                          ///< metres for a height of 1; a plain factor for normals and slopes
    Vec3 falloff{0.1, 0.1, 0.1};               ///< share that fades: box x, y, z; sphere radius; cone radius, -, length
    std::array<double, 2> angle_fade{0.25, 0.5};  ///< as DecalLayer's
    bool two_sided = false;                       ///< false: nothing on surfaces that face away from the projector
    Wrap wrap = Wrap::clamp;
    std::array<double, 2> repeat{1, 1};  ///< times the region repeats over the box, with Wrap::repeat
    ProjectorMode mode = ProjectorMode::add;
    double opacity = 1;
    double priority = 0;             ///< lower ones first; equal ones in the order of the table
    std::optional<double> object{};  ///< only pixels with this object index
    std::string cryptomatte{};       ///< only this object, by its coverage; name, or "#" and 8 hex digits
    std::uint32_t line = 0;          ///< of the table's file, for messages; 0 in files without lines
};

/// Many decals. Those that add are independent of order; one that replaces takes g to g + (d - g) weight of what the
/// rows of the same table before it made.
struct DecalsLayer {
    static constexpr const char* kind = "decals";
    std::vector<TextureUse> textures{};  ///< slopes are metres over metres, whatever their unit says
    std::shared_ptr<const std::vector<Projector>> rows{};
    std::filesystem::path file{};  ///< that the rows are from, for messages; empty for rows made in code
};

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

enum class Blend { add, subtract };

struct Layer {
    std::string name;      ///< unique; "kind N" when the file gives none
    std::string location;  ///< "scene.toml:12" for messages; empty for layers made in code
    std::variant<NormalMapLayer, HeightMapLayer, HeightChannelLayer, TriplanarLayer, NoiseLayer, DecalLayer,
                 DecalsLayer, ConstantLayer, ResolveLayer, ObjectNormalLayer, DerivativeMapLayer, ParallaxLayer,
                 VolumeLayer>
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

// --- Where the pixels come from and what is written ------------------------------------------------------------------

enum class Geometry { automatic, depth, position };
enum class DepthKind { automatic, planar, ray };

struct GBufferSource {
    std::filesystem::path file;  ///< may hold #### or %04d for the frame number
    std::map<std::string, std::string>
        roles;  ///< role (see wrinkle/gbuffer.h) to channel or layer name: overrides detection
    Geometry geometry = Geometry::automatic;  ///< automatic prefers depth, for its digits
    DepthKind depth = DepthKind::automatic;   ///< automatic: by the writer
};

struct CameraSource {
    std::filesystem::path file;           ///< JSON with view, proj (rows); may hold the frame pattern
    bool exr = false;                     ///< worldToCamera, worldToNDC (and their kin) of the G-buffer's header
    std::optional<Camera> inline_camera;  ///< matrices as given
    /// Set with `eye`, `target`, `fov`: aspect comes from the frame.
    struct LookAt {
        Vec3 eye{}, target{}, up{0, 0, 1};
        double fov_y = 0;
    };
    std::optional<LookAt> look_at;
    double max_residual = 0.5;  ///< pixels; a camera that reprojects positions worse than this is refused
};

enum class LightKind { sun, point, spot };

struct Light {
    LightKind kind = LightKind::sun;
    Vec3 color{1, 1, 1};  ///< sun: irradiance at normal incidence; point, spot: radiant intensity (times intensity)
    double intensity = 1;
    Vec3 position{};                              ///< world; point, spot
    Vec3 direction{0, 0, -1};                     ///< the way the light travels; sun, spot
    double inner_angle = 0.4, outer_angle = 0.6;  ///< radians from the axis; spot
};

enum class Relight { off, lit, ratio };

struct Lighting {
    Relight relight = Relight::off;
    Vec3 ambient{0, 0, 0};
    Vec3 albedo{0.5, 0.5, 0.5};  ///< where the G-buffer has none
    double roughness = 0.5;      ///< where the G-buffer has none
    double f0 = 0.04;            ///< specular reflectance at normal incidence
    double max_ratio = 4;        ///< bound of lit(new)/lit(old), and 1/bound below
    double exposure = 0;         ///< stops, of the PNG only
    std::vector<Light> lights;
};

struct Output {
    bool surface_gradient = false, dp_dx = false, dp_dy = false, marked = false;  ///< beside the normal
    bool condition = false;    ///< how the normal magnifies input errors; by render(), not by a pass (run/condition.h)
    bool passthrough = false;  ///< copy the channels and metadata of the input
    bool half = false;         ///< 16-bit floats
    bool png = true;           ///< lit.png beside lit.exr when relighting; normal.png too
};

/// How large an error of the normals may be, and how it is measured: a seeded sample of pixels is evaluated in double.
struct ErrorBudget {
    std::optional<double> max_error;  ///< degrees, of any sampled pixel; nothing: standard precision, not measured
    int sample = 4096;                ///< pixels
    int seed = 1;
};

struct Scene {
    std::filesystem::path file;  ///< empty for scenes made in code
    GBufferSource gbuffer;
    CameraSource camera;
    std::vector<Layer> layers;
    Lighting lighting;
    Output output;
    ErrorBudget budget;
};

/// Reads a table of decals: CSV, a row of column names, then a row a decal; TOML (.toml), a [[decal]] a row; or .npy,
/// records with fields named as the columns of CSV are; data/scenes/README.md lists them. Throws Error with the line
/// (.npy: the row) and column of each mistake, the first 20 of them. `textures`: how many textures rows may name.
std::vector<Projector> load_decals(const std::filesystem::path& file, std::size_t textures);

/// Writes one that load_decals reads back to the same numbers: TOML if it is named .toml, else CSV.
void save_decals(const std::filesystem::path& file, const std::vector<Projector>& rows);

/// Reads and checks a scene in full; relative paths are relative to the scene's folder.
/// Throws Error listing every problem as "file:line: what was found; what is allowed", nearest known key included.
Scene load_scene(const std::filesystem::path& file);

}  // namespace wrinkle
