#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/reference/camera_rays.h"
#include "tests/reference/mask.h"
#include "tests/reference/resolve.h"
#include "tests/reference/uv_derivative.h"
#include "tests/reference/vertex_frame.h"
#include "wrinkle/gbuffer.h"
#include "wrinkle/scene.h"

namespace wrinkle::reference {

using Planes = std::map<std::string, std::span<const float>>;  ///< names of wrinkle/gbuffer.h

/// A decoded pixel: its position, and its unit base normal, which faces the viewer.
template <class T>
struct Decoded {
    bool valid = false, reflected = false;
    Vec<T> position;  ///< eye-relative
    Vec<T> view;      ///< unit, towards the viewer
    Vec<T> normal;
};

/// The G-buffer side of the evaluation: decodes pixels, differentiates the UV plane.
template <class T>
class Frame {
public:
    /// Geometry comes from depth when `source` says so, or when it leaves that open and there is a depth plane. Depth
    /// is planar unless `source` says that it is measured along the ray.
    Frame(const GBufferSource& source, Size size, const Camera& camera, Planes planes)
        : size_(size), rays_(camera, size), planes_(std::move(planes)) {
        const bool automatic = source.geometry == Geometry::automatic && planes_.contains("depth");
        from_depth_ = source.geometry == Geometry::depth || automatic;
        ray_distance_ = source.depth == DepthKind::ray;
        for (const char* axis : {"x", "y", "z"}) {
            normal_.push_back(planes_.at(std::string("normal.") + axis));
            if (!from_depth_) position_.push_back(planes_.at(std::string("position.") + axis));
        }
        if (from_depth_) depth_ = planes_.at("depth");
        if (planes_.contains("object")) object_ = planes_.at("object");
        for (int rank = 0; has("crypto.id" + std::to_string(rank)); ++rank)
            ranks_.emplace_back(plane("crypto.id" + std::to_string(rank)),
                                plane("crypto.coverage" + std::to_string(rank)));
    }

    Size size() const { return size_; }
    const CameraRays<T>& rays() const { return rays_; }
    Vec2<T> centre(std::size_t i) const { return {T(i % size_.width) + T(1) / 2, T(i / size_.width) + T(1) / 2}; }
    bool has(const std::string& name) const { return planes_.contains(name); }
    std::span<const float> plane(const std::string& name) const { return planes_.at(name); }
    Vec<T> raw_normal(std::size_t i) const { return {T(normal_[0][i]), T(normal_[1][i]), T(normal_[2][i])}; }

    /// How much of pixel i the Cryptomatte object of this name covers.
    T coverage(std::size_t i, const std::string& name) const {
        std::vector<std::pair<float, float>> pairs;
        for (const auto& [id, coverage] : ranks_) pairs.emplace_back(id[i], coverage[i]);
        return cryptomatte_coverage<T>(pairs, cryptomatte_bits(name));
    }

    /// The object whose surface pixel i shows: the frame's word for it, or the one that comes first.
    std::uint32_t front(std::size_t i) const {
        return std::bit_cast<std::uint32_t>(plane(has("crypto.front") ? "crypto.front" : "crypto.id0")[i]);
    }

    Decoded<T> decode(std::size_t i) const {
        Decoded<T> d;
        const Vec<T> n = raw_normal(i);
        if (!finite(n) || is_zero(n)) return d;
        const Vec2<T> xy = centre(i);
        if (from_depth_) {
            const T depth = depth_[i];
            if (!(depth > 0 && depth < T(1e9))) return d;
            d.position = ray_distance_ ? rays_.at_distance(xy.x, xy.y, depth) : rays_.at_depth(xy.x, xy.y, depth);
        } else {
            const Vec<T> p{T(position_[0][i]), T(position_[1][i]), T(position_[2][i])};
            if (!finite(p)) return d;
            d.position = p - rays_.eye();
        }
        d.valid = true;
        d.view = rays_.view(d.position, xy.x, xy.y);
        const Vec<T> unit = normalize(n);
        d.reflected = dot(unit, d.view) < 0;
        d.normal = face_viewer(unit, d.view);
        return d;
    }

    ScreenDerivative<T> derivative(std::size_t i, Vec<T> position, Vec<T> normal) const {
        const Vec2<T> xy = centre(i);
        return rays_.derivative(position, normal, xy.x, xy.y);
    }

    Vec2<T> uv(std::size_t i) const { return {T(plane("uv.u")[i]), T(plane("uv.v")[i])}; }

    /// d(u,v)/d(x,y) of the UV plane: from the planes duv_dx and duv_dy, else from dp_du and dp_dv, else from
    /// neighbours. Nothing when none of these gives any. `base`: dp_dx and dp_dy of the pixel on its base normal.
    std::optional<TexDerivative<T>> uv_derivative(std::size_t i, const Decoded<T>& here,
                                                  const ScreenDerivative<T>& base) const {
        std::optional<Vec2<T>> dx, dy;
        if (has("duv_dx.u") && has("duv_dy.u")) {
            dx = {T(plane("duv_dx.u")[i]), T(plane("duv_dx.v")[i])};
            dy = {T(plane("duv_dy.u")[i]), T(plane("duv_dy.v")[i])};
        } else if (has("dp_du.x") && has("dp_dv.x")) {
            const auto read = [&](const std::string& name) {
                return Vec<T>{T(plane(name + ".x")[i]), T(plane(name + ".y")[i]), T(plane(name + ".z")[i])};
            };
            const Vec<T> dp_du = read("dp_du"), dp_dv = read("dp_dv");
            dx = uv_derivative_from_tangents(base.dp_dx, dp_du, dp_dv);
            dy = uv_derivative_from_tangents(base.dp_dy, dp_du, dp_dv);
        } else {
            const auto x = from_neighbours(i, here, 1, i % size_.width, size_.width, base.dp_dx);
            const auto y = from_neighbours(i, here, size_.width, i / size_.width, size_.height, base.dp_dy);
            if (x && y) std::tie(dx, dy) = uv_derivatives(*x, *y, base.dp_dx, base.dp_dy);
        }
        if (!dx || !dy || !finite(*dx) || !finite(*dy) || !finite(uv(i))) return std::nullopt;
        return TexDerivative<T>{*dx, *dy};
    }

    /// Change of a height plane to the pixels at the right and below, or from those at the left and above. Nothing when
    /// those are not on the same surface. `base` as above.
    std::optional<Vec2<T>> height_slope(std::size_t i, const Decoded<T>& here, const ScreenDerivative<T>& base,
                                        const std::string& name) const {
        const std::span<const float> h = plane(name);
        if (!std::isfinite(h[i])) return std::nullopt;
        const auto along = [&](std::size_t stride, std::size_t index, std::size_t count, Vec<T> dp) {
            const bool first = index == 0, last = index + 1 == count;
            const UvPixel<T> before = first ? UvPixel<T>{} : neighbour(i - stride);
            const UvPixel<T> after = last ? UvPixel<T>{} : neighbour(i + stride);
            return height_difference(uv_pixel(i, here), before, after, T(h[i]), T(first ? 0 : h[i - stride]),
                                     T(last ? 0 : h[i + stride]), dp);
        };
        const std::optional<T> x = along(1, i % size_.width, size_.width, base.dp_dx);
        const std::optional<T> y = along(size_.width, i / size_.width, size_.height, base.dp_dy);
        if (!x || !y) return std::nullopt;
        return Vec2<T>{*x, *y};
    }

    bool has_vertex_frame() const { return has("tangent.z") && (has("tangent_sign") || has("bitangent.z")); }

    /// The renderer's tangents. Nothing when they are not finite.
    std::optional<TangentFrame<T>> vertex_frame(std::size_t i) const {
        const auto read = [&](const std::string& name) {
            return Vec<T>{T(plane(name + ".x")[i]), T(plane(name + ".y")[i]), T(plane(name + ".z")[i])};
        };
        const Vec<T> n = raw_normal(i), tangent = read("tangent");
        if (!finite(tangent)) return std::nullopt;
        if (has("tangent_sign")) {
            const T sign = plane("tangent_sign")[i];
            if (!std::isfinite(sign)) return std::nullopt;
            return reference::vertex_frame(n, tangent, sign);
        }
        const Vec<T> bitangent = read("bitangent");
        if (!finite(bitangent)) return std::nullopt;
        return TangentFrame<T>{tangent / length(n), bitangent / length(n), false};
    }

    /// dn/dx and dn/dy of the frame's normals, made unit, by differences of neighbours.
    ScreenDerivative<T> normal_derivative(std::size_t i, const Decoded<T>& here,
                                          const ScreenDerivative<T>& base) const {
        const auto along = [&](std::size_t stride, std::size_t index, std::size_t count, Vec<T> dp) {
            const UvPixel<T> before = index == 0 ? UvPixel<T>{} : neighbour(i - stride);
            const UvPixel<T> after = index + 1 == count ? UvPixel<T>{} : neighbour(i + stride);
            return normal_difference(uv_pixel(i, here), before, after, dp);
        };
        return {along(1, i % size_.width, size_.width, base.dp_dx),
                along(size_.width, i / size_.width, size_.height, base.dp_dy)};
    }

private:
    UvPixel<T> uv_pixel(std::size_t i, const Decoded<T>& d) const {
        std::optional<float> object;
        if (!object_.empty()) object = object_[i];
        return {d.valid, object, d.valid ? normalize(raw_normal(i)) : Vec<T>{}, d.position,
                has("uv.u") ? uv(i) : Vec2<T>{}};
    }

    /// Pixel i as a neighbour of others. It is invalid when its normal is longer than 1e19 or shorter than 1e-19.
    UvPixel<T> neighbour(std::size_t i) const {
        UvPixel<T> pixel = uv_pixel(i, decode(i));
        const T size = length(raw_normal(i));
        pixel.valid = pixel.valid && size > T(1e-19L) && size < T(1e19L);
        return pixel;
    }

    /// The change along one axis of the picture: pixel i is number `index` of `count` along it, and its neighbours are
    /// pixels i + stride and i - stride.
    std::optional<UvChange<T>> from_neighbours(std::size_t i, const Decoded<T>& here, std::size_t stride,
                                               std::size_t index, std::size_t count, Vec<T> dp) const {
        const UvPixel<T> centre = uv_pixel(i, here);
        const UvPixel<T> after = index + 1 < count ? neighbour(i + stride) : UvPixel<T>{};
        const UvPixel<T> before = index > 0 ? neighbour(i - stride) : UvPixel<T>{};
        const auto [forward, backward] = uv_differences(centre, before, after, dp);
        return combine_differences(forward, backward);
    }

    Size size_;
    CameraRays<T> rays_;
    Planes planes_;
    bool from_depth_ = false, ray_distance_ = false;
    std::vector<std::span<const float>> normal_, position_;
    std::span<const float> depth_, object_;
    std::vector<std::pair<std::span<const float>, std::span<const float>>> ranks_;  ///< Cryptomatte: ids, coverages
};

}  // namespace wrinkle::reference
