#pragma once

#include "plan/section.h"

namespace wrinkle {

/// What the kinds of layers share when they become kernel text. The text stands in a block where `m` holds the mask and
/// `active` the lanes that want the layer; it adds to g or dh_dp.
struct LayerText {
    Emitter& emitter;
    const Layer& layer;
    const std::string who;  ///< starts messages
    Section& section;

    /// The layer's scale, with the sign of its blend.
    std::string strength() const;
    /// What ends the name of a kernel function that has an exact variant.
    const char* exactly() const;
    /// Level of detail of texture `t` for these derivatives of its coordinates.
    std::string lod(const std::string& dx, const std::string& dy) const;
    /// Declares coordinates `c`, texture `t` and its sample, for a source that samples one texture over a UV mapping.
    std::string textured(const TextureUse& use, const UvMapping& uv, const char* declared = "wr_vec2 slope");
    /// Declares coordinates `c` and texture `t`.
    std::string located(const TextureUse& use, TexelKind kind, const UvMapping& uv);
    /// Adds the surface gradient of a height, of the kernel function of that name and its arguments after dp_dx, dp_dy.
    std::string slopes(const std::string& function, const std::string& arguments);
    /// Adds a volume gradient, to be projected onto the surface unless the layer says otherwise.
    std::string volume(const std::string& gradient);
};

/// How the texels of `use` are stored.
TexelKind texel_kind(const TextureUse& use);
/// Kernel text that samples `use`, a texture `t`; slopes only where the mask `wanted` holds, if there is one.
std::string sample_text(const TextureUse& use, const std::string& st, const std::string& lod,
                        const std::string& wanted = "");
/// Expected operations of such a sample.
double sample_cost(const TextureUse& use);

/// The space that noise is evaluated in, and its kernel text. Three coordinates: axes . p + offset, p in the world.
struct NoiseSpace {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 offset{};
    std::string point = "p";  ///< axes . p, p relative to the eye
    std::string footprint = "wr_footprint_size(dp_dx, dp_dy)", active = "active";
};
/// Declares `f`, the value of a noise layer and its gradient along those coordinates.
std::string noise_over(LayerText& at, const NoiseLayer& l, const NoiseSpace& space);

/// Directions of an object's axes in world space.
std::array<Vec3, 3> object_axes(const Placement& placement);

/// Kernel text of a layer, one function a kind.
std::string emit(LayerText& at, const NormalMapLayer& l);
std::string emit(LayerText& at, const HeightMapLayer& l);
std::string emit(LayerText& at, const HeightChannelLayer& l);
std::string emit(LayerText& at, const TriplanarLayer& l);
std::string emit(LayerText& at, const NoiseLayer& l);
std::string emit(LayerText& at, const ConstantLayer& l);
std::string emit(LayerText& at, const DecalsLayer& l);
std::string emit(LayerText& at, const VolumeLayer& l);
std::string emit(LayerText& at, const ObjectNormalLayer& l);
std::string emit(LayerText& at, const DerivativeMapLayer& l);
std::string emit(LayerText& at, const ParallaxLayer& l);

/// How far parallaxes may move a point before the last table of decals sees it.
struct MovedPoints {
    std::string text;        ///< adds to `nearer` and `farther`, metres along the ray, going by n, v and distance
    bool by_normal = false;  ///< the text reads n, the base normal
};
MovedPoints moved_points(const Emitter& emitter, const std::string& indent);

/// Decals that may share a loop: same mask, same way to sample.
bool same_loop(const Layer& a, const Layer& b);
/// Consecutive decals as one loop.
std::string emit_decals(LayerText& at, const std::vector<const Layer*>& layers);

}  // namespace wrinkle
