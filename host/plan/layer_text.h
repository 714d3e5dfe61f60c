#pragma once

#include "plan/section.h"

namespace wrinkle {

/// What the kinds of layers share when they become kernel text. The text stands in a block where `m` holds the mask and
/// `active` the lanes that want the layer; it adds to g or dh_dp.
struct LayerText {
    Emitter& emitter;
    const std::vector<const Layer*>& layers;  ///< that share a section; one, unless its kind joins them
    const Layer& layer;                       ///< the first of them
    const std::string who;                    ///< starts messages
    Section& section;
    /// What does not differ between the points of a pixel's area: declarations, and the statements that set them, which
    /// stand before the first point and are skipped where no pixel wants the layer. Both empty where it has one point.
    std::string declared{}, prepared{};
    bool loses = false;  ///< `lost` is declared: what slopes vary by that are finer than a point's share of the area

    /// Kernel text of a number of the layer, or of three as a vector; `what`: for people to read.
    std::string number(const std::string& what, std::function<double(const Layer&)> of) {
        return emitter.number(layer, what, std::move(of));
    }
    std::string vector(const std::string& what, std::function<Vec3(const Layer&)> of) {
        return emitter.vector(layer, what, std::move(of));
    }
    /// The layer's scale, with the sign of its blend.
    std::string strength();
    /// What ends the name of a kernel function that has an exact variant.
    const char* exactly() const;
    /// Kernel text of a value that does not differ between the points of a pixel's area, set once for all of them.
    std::string once(const char* type, const char* name, const std::string& value);
    /// Level of detail of texture `t` for these derivatives of its coordinates.
    std::string lod(const std::string& dx, const std::string& dy) const;
    /// Declares coordinates `c`, by the layer's own mapping, texture `t` and its sample.
    std::string textured(const TextureUse& use, const char* declared = "wr_vec2 slope");
    /// Declares coordinates `c` and texture `t`.
    std::string located(const TextureUse& use, TexelKind kind);
    /// Adds the surface gradient of a height, of the kernel function of that name and its arguments after dp_dx, dp_dy.
    std::string slopes(const std::string& function, const std::string& arguments);
    /// Whether the layer is evaluated at several points of the pixel's area, whose footprints are alike.
    bool over_area() const;
    /// Whether the layer is to tell what of it is finer than a point's share of the pixel's area, by adding that
    /// covariance of slopes to `finer`.
    bool tells_spread() const;
    /// Adds the covariance `lost` of slopes along s and t, given the kernel text of the surface gradient that a slope
    /// of 1 along s makes, and one along t. Nothing where it is not to be told.
    std::string spread(const std::string& along_s, const std::string& along_t);
    /// Adds a volume gradient, to be projected onto the surface unless the layer says otherwise.
    std::string volume(const std::string& gradient);
};

/// The mapping of a layer; null where it has none.
const UvMapping* find_uv(const Layer& layer);
/// The mapping of a layer that has one.
inline const UvMapping& own_uv(const Layer& layer) { return *find_uv(layer); }

/// How the texels of `use` are stored.
TexelKind texel_kind(const TextureUse& use);
/// Kernel text that samples `use`, a texture `t`; slopes only where the mask `wanted` holds, if there is one.
std::string sample_text(const TextureUse& use, const std::string& st, const std::string& lod,
                        const std::string& wanted = "");
/// Expected operations of such a sample.
double sample_cost(const TextureUse& use);

/// How far layers may move a point before the last table of decals sees it.
struct MovedPoints {
    std::string text;        ///< adds to `nearer` and `farther`, metres along the ray, going by n, v and distance
    bool by_normal = false;  ///< the text reads n, the base normal
};
MovedPoints moved_points(Emitter& emitter, const std::string& indent);

}  // namespace wrinkle
