#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include "baseline.h"
#include "texture.h"
#include "uv.h"

/// The layers of a scene, with everything precomputed that is the same for all pixels.
namespace wrinkle::baseline {

using Slopes = std::shared_ptr<const Pyramid<float2>>;
using Scalars = std::shared_ptr<const Pyramid<float>>;

/// Slopes per unit s, t, from a height map or a normal map. With upscale = "plain", texels stay heights (`plain`) and
/// are differenced at every sample; else they were made slopes when they were loaded (`slopes`).
struct SlopeSource {
    Slopes slopes;
    Scalars plain;
    float2 sample(const Uv& uv, bool use_footprint) const {
        if (slopes != nullptr) {
            const float lod = use_footprint ? foot(*slopes, uv).lod : 0.0F;
            return slopes->trilinear(uv.st, lod);
        }
        return plain_height_slope(*plain, uv.st, use_footprint ? foot(*plain, uv) : Footprint{});
    }

private:
    template <class T>
    static Footprint foot(const Pyramid<T>& pyramid, const Uv& uv) {
        return footprint(uv.dst_dx, uv.dst_dy, pyramid.width(), pyramid.height(), pyramid.top());
    }
};

struct PreparedMask {
    bool any = false, invert = false;
    std::optional<float> object;
    std::optional<std::uint32_t> cryptomatte;
    int channel = -1;  ///< index into LayerBuilder::channels; -1: none
    Scalars texture;
    UvTransform uv;
};

struct NormalMap {
    SlopeSource source;
    UvTransform uv;
};
struct HeightMap {
    SlopeSource source;
    UvTransform uv;
};
struct Triplanar {
    SlopeSource source;
    float per_tile, slope_scale, sharpness;
};
struct Noise {
    struct Octave {
        float frequency, amplitude;  ///< amplitude of the gradient: gain^i times the frequency, by the chain rule
    };
    std::vector<Octave> octaves;
};
struct Decal {
    SlopeSource source;
    float3 to_x, to_y, to_z;  ///< q.x = to_x . p - centre.x, inside the box within [-1, 1]
    float3 centre;
    float3 axis_z;
    float3 grad_s, grad_t;  ///< volume gradient per unit slope
    float per_falloff;      ///< 1 / falloff; 0: hard edges
    float fade_from, per_fade;
};
struct Constant {
    float3 gradient;
};

struct PreparedLayer {
    std::variant<NormalMap, HeightMap, Triplanar, Noise, Decal, Constant> bump;
    float scale = 1;
    bool footprint = true;
    PreparedMask mask;
};

/// The layers between two resolves.
struct Stage {
    std::vector<PreparedLayer> layers;
    bool screen_derivatives = false;
};

class LayerBuilder {
public:
    LayerBuilder(const CameraTerms& camera, const std::map<std::filesystem::path, Image>& textures,
                 const std::map<std::string, std::uint32_t>& cryptomatte)
        : camera_(camera), textures_(textures), cryptomatte_(cryptomatte) {}

    std::vector<Stage> stages(const Scene& scene);
    std::vector<std::string> channels;  ///< read by masks; PreparedMask::channel is an index into them
    bool aov_uv = false;                ///< some layer or mask reads the UV plane

private:
    PreparedLayer layer(const Layer& in);
    PreparedMask mask(const Mask& in);
    NormalMap bump(const NormalMapLayer& in);
    HeightMap bump(const HeightMapLayer& in);
    Triplanar bump(const TriplanarLayer& in);
    static Noise bump(const NoiseLayer& in);
    Decal bump(const DecalLayer& in);
    static Constant bump(const ConstantLayer& in) { return {to_float3(in.gradient)}; }
    UvTransform uv(const UvMapping& mapping);
    SlopeSource source(const TextureUse& use, Wrap wrap);
    Scalars scalars(const std::filesystem::path& file, Wrap wrap);
    const Image& image(const std::filesystem::path& file) const;

    const CameraTerms& camera_;
    const std::map<std::filesystem::path, Image>& textures_;
    const std::map<std::string, std::uint32_t>& cryptomatte_;
    std::map<std::tuple<std::filesystem::path, Content, Wrap, bool>, Slopes> slope_cache_;
    std::map<std::pair<std::filesystem::path, Wrap>, Scalars> scalar_cache_;
};

}  // namespace wrinkle::baseline
