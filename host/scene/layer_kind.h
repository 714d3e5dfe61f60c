#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/vector_source.h"
#include "wrinkle/layers.h"
#include "wrinkle/precision.h"
#include "wrinkle/scene.h"

namespace wrinkle {

namespace scene {
class Table;
}
struct Available;
struct Emitter;
struct LayerText;
enum class CameraKind : int;

/// A use of a kind of layer, and the roles of a G-buffer that it needs beyond a normal, a geometry and a camera.
struct LayerUse {
    const char* how;                     ///< "tangents = \"passes\""; empty: as it is
    std::span<const char* const> roles;  ///< "uv"; of "tangent_sign or bitangent" one will do
};

/// What rows of the table of costs are about: a kind of layer, split where its costs differ by far.
struct CostKind {
    std::string name;  ///< "height_map", "noise simplex"
    double units = 1;  ///< that costs grow with: octaves of noise
};

/// An object that a row of a layer's own table is meant for.
struct NamedObject {
    std::string cryptomatte{};  ///< a name, or "#" and 8 hex digits; empty: an object index
    double index = 0;
    std::string place{};  ///< "decals.csv:12"
};

/// How far a layer may move the point that a pixel shows, as kernel text. Tiles of decals need it before any layer is
/// evaluated, to cover every place where the point may end up.
struct MovedPoint {
    std::string nearer, farther;  ///< metres along the ray, by n, v and distance
    bool by_normal = false;       ///< the text reads n, the base normal
    bool turns = false;           ///< the layer turns n: text of later ones must not go by it
};

/// All there is to know of a kind of layer, as data: one row a kind, in layers/KIND.cpp. Whoever handles layers of any
/// kind is handed the rows, and asks them. What a kind has no use for stays empty.
struct LayerKind {
    const char* name;
    /// Reads the keys of a [[layer]] and says what is wrong with them.
    void (*read)(scene::Table& table, Layer& layer);
    /// Its kernel text, which adds to g or dh_dp (plan/layer_text.h).
    std::string (*emit)(LayerText& at) = nullptr;

    std::span<const LayerUse> uses{};  ///< none: as it is, without further roles
    bool once_a_pixel = false;         ///< it goes by neighbouring pixels, or moves the pixel's point
    bool ends_stage = false;           ///< it is no bump: the surface made so far is what later layers bump
    bool without_normal = false;       ///< it is a gradient in space, good without any normal (accumulate_decals)
    bool users_own = false;            ///< the user wrote what it computes: only measuring tells what that costs
    bool binned = false;               ///< it has a table of projectors that are binned to tiles of the frame

    /// The variants in float that layer `index` of a scene has, from cheap to exact; null: standard only.
    std::vector<Precision> (*variants)(const Scene& scene, std::size_t index, CameraKind camera) = nullptr;
    /// What its costs are filed under; null: its name.
    CostKind (*cost)(const Layer& layer) = nullptr;
    /// Looks into the files of a layer for what a plan must know of them. Throws Error naming the file.
    void (*look)(const Layer& layer, Available& available) = nullptr;
    /// Objects that its own rows name, each once.
    std::vector<NamedObject> (*objects)(const Layer& layer) = nullptr;
    /// Where the vectors come from that it reads as planes of its own, own_vectors(); nothing: it reads none.
    std::optional<io::VectorSource> (*vectors)(const Layer& layer) = nullptr;
    /// Whether `next` may share the loop of the layer before it.
    bool (*joins)(const Layer& layer, const Layer& next) = nullptr;
    /// Where it may move the point of a pixel to; `own_normal`: n is still the base normal.
    MovedPoint (*moves)(Emitter& emitter, const Layer& layer, bool own_normal) = nullptr;
};

/// The layer's scale, with the sign of its blend.
inline double signed_scale(const Layer& layer) { return layer.blend == Blend::subtract ? -layer.scale : layer.scale; }

/// Name of the planes .x, .y and .z that hold the vectors of the layer at a place of the scene. It does not hold the
/// layer's name, so that renaming a layer compiles nothing.
inline std::string own_vectors(std::size_t index) { return "gradient" + std::to_string(index); }

/// Every kind of layer, in the order of the alternatives of Layer::bump; layers/kinds.h has them.
using LayerKinds = std::span<const LayerKind* const>;

inline const LayerKind& kind_of(LayerKinds kinds, const Layer& layer) { return *kinds[layer.bump.index()]; }

/// The variants in float that layer `index` has, from cheap to exact; standard is always among them.
inline std::vector<Precision> layer_precisions(LayerKinds kinds, const Scene& scene, std::size_t index,
                                               CameraKind camera) {
    const LayerKind& kind = kind_of(kinds, scene.layers[index]);
    return kind.variants ? kind.variants(scene, index, camera) : std::vector{Precision::standard};
}

inline CostKind cost_kind(LayerKinds kinds, const Layer& layer) {
    const LayerKind& kind = kind_of(kinds, layer);
    return kind.cost ? kind.cost(layer) : CostKind{kind.name};
}

}  // namespace wrinkle
