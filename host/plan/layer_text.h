#pragma once

#include "plan/section.h"

namespace wrinkle {

/// Writes the kernel text of a layer. The text goes into a block in which `m` is the mask and `active` holds the lanes
/// where the mask is not 0; it adds to g, the surface gradient, or dh_dp, the volume gradient.
struct LayerText {
    Emitter& emitter;
    const std::vector<const Layer*>& layers;  ///< of the section: one, or several of a kind that joins them
    const Layer& layer;                       ///< the first of them
    const std::string who;                    ///< starts messages
    Section& section;
    const bool space;  ///< a layer before it in the stage adds to dh_dp
    /// What holds for all points of a pixel's area: `declared`, declarations before the loop over the points; `before`,
    /// statements there; `prepared`, statements that are there too, but on one lane are at every point: registers are
    /// the scarcer there, and what is computed anew takes none between points. Both are skipped where no pixel wants
    /// the layer. All are empty where there is no such loop.
    std::string declared{}, before{}, prepared{};
    /// The layer's text has declared `lost`: the covariance of slopes finer than one point's share of the area.
    bool loses = false;
    /// Set by a layer whose text, at one point, also needs the lanes that want the layer at another point only:
    /// `active` then holds, at every point, all lanes that may want the layer at some point.
    bool active_at_any_point = false;

    /// Kernel text of a number of the layer, or of three as a vector; `what` names it in messages.
    std::string number(const std::string& what, std::function<double(const Layer&)> of) {
        return emitter.number(layer, what, std::move(of));
    }
    std::string vector(const std::string& what, std::function<Vec3(const Layer&)> of) {
        return emitter.vector(layer, what, std::move(of));
    }
    /// Index of the first of nine numbers of the layer: a matrix, row by row.
    std::size_t matrix(const std::string& what, std::function<std::array<Vec3, 3>(const Layer&)> of);
    /// Statement that multiplies the vector `v` by such a matrix.
    std::string turned(const std::string& what, std::function<std::array<Vec3, 3>(const Layer&)> of);
    /// The layer's scale, with the sign of its blend.
    std::string strength();
    /// "_exact" if the layer is to use the exact variants of kernel functions, which have names that end so; else "".
    const char* exactly() const;
    /// Kernel text of a value that is the same at every point of a pixel's area, and may be computed once for all of
    /// them.
    std::string once(const char* type, const char* name, const std::string& value);
    /// Text of the level of detail of texture `t`, given the screen derivatives of its coordinates.
    std::string lod(const std::string& dx, const std::string& dy) const;
    /// Declares coordinates `c`, by the layer's own mapping, texture `t`, and its sample under the name in `declared`.
    std::string textured(const TextureUse& use, const char* declared = "wr_vec2 slope");
    /// Declares coordinates `c` and texture `t`.
    std::string located(const TextureUse& use, TexelKind kind);
    /// Adds the surface gradient that wr_surface_gradient_FUNCTION(n, dp_dx, dp_dy, ARGUMENTS) gives.
    std::string slopes(const std::string& function, const std::string& arguments);
    /// Whether the layer is evaluated at several points of the pixel's area; they all have the same footprint.
    bool over_area() const;
    /// Whether the layer has to report the detail that a point's footprint averages away: it adds the covariance of
    /// those slopes to `finer`.
    bool tells_spread() const;
    /// Text that adds to `finer` what `lost`, the covariance of slopes along s and t, is as one of surface gradients.
    /// Empty unless tells_spread().
    ///   along_s, along_t   text of the surface gradients that a slope of 1 along s, and one along t, makes
    std::string spread(const std::string& along_s, const std::string& along_t);
    /// Kernel text of the surface gradient of all layers before this one in the stage.
    std::string below();
    /// Adds a volume gradient: to dh_dp, which is projected onto the surface later, or to g if the layer is not
    /// projected.
    std::string volume(const std::string& gradient);
};

/// The mapping of a layer; null where it has none.
const UvMapping* find_uv(const Layer& layer);
/// The mapping of a layer that has one.
inline const UvMapping& own_uv(const Layer& layer) { return *find_uv(layer); }

/// How the texels of `use` are stored.
TexelKind texel_kind(const TextureUse& use);
/// Kernel text that samples `use` from texture `t`. Lanes outside the mask `wanted`, if one is given, may get slopes of
/// 0.
std::string sample_text(const TextureUse& use, const std::string& st, const std::string& lod,
                        const std::string& wanted = "");
/// Expected operations of such a sample.
double sample_cost(const TextureUse& use);

/// How far layers may move a point before the last table, of decals or of lights, is evaluated there: tiles must cover
/// that way.
struct MovedPoints {
    std::string text;        ///< adds to `nearer` and `farther`, metres along the ray; reads v, distance and perhaps n
    bool by_normal = false;  ///< the text reads n, the base normal
};
MovedPoints moved_points(Emitter& emitter, const std::string& indent);

}  // namespace wrinkle
