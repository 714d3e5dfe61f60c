#include "tools/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <unordered_map>

#include "base/imath.h"
#include "io/background.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

using Imath::V3d;

/// Numbers that are the same with every standard library, which distributions of <random> are not.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : engine_(seed) {}
    double share() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }  ///< [0,1)
    double between(double low, double high) { return low + (high - low) * share(); }
    std::size_t below(std::size_t count) { return static_cast<std::size_t>(share() * static_cast<double>(count)); }

private:
    std::mt19937_64 engine_;
};

/// Points no nearer to each other than a distance, found by cells of that size.
class Spaced {
public:
    explicit Spaced(double distance) : distance_(distance) {}

    /// Adds a point unless another is too near.
    bool add(const V3d& p) {
        if (distance_ <= 0) return true;
        std::array<std::int64_t, 3> cell{};
        for (std::size_t k = 0; k < 3; ++k)
            cell[k] = static_cast<std::int64_t>(std::floor(p[static_cast<int>(k)] / distance_));
        for (std::int64_t i = 0; i < 27; ++i) {
            const auto found = cells_.find(key({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1}));
            if (found == cells_.end()) continue;
            for (const V3d& other : found->second)
                if ((p - other).length2() < distance_ * distance_) return false;
        }
        cells_[key(cell)].push_back(p);
        return true;
    }

private:
    static std::uint64_t key(const std::array<std::int64_t, 3>& c) {
        std::uint64_t k = 0;
        for (const std::int64_t v : c) k = (k ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u;
        return k;
    }

    double distance_;
    std::unordered_map<std::uint64_t, std::vector<V3d>> cells_;
};

/// The surface at a pixel.
struct Surface {
    V3d position, normal;
    double pixel = 0;  ///< metres of a pixel that faces the viewer
};

class Pixels {
public:
    Pixels(const Frame& frame, const HostPlanes& planes) : frame_(frame) {
        if (const auto rays = pinhole_rays(frame.camera, frame.size))
            rays_ = {to_imath(rays->eye), to_imath(rays->d0), to_imath(rays->dx), to_imath(rays->dy)};
        for (const char* name : {"normal.x", "normal.y", "normal.z"}) normal_.push_back(plane(planes, name));
        if (planes.contains("depth") && rays_) {
            depth_ = plane(planes, "depth");
            return;
        }
        if (!planes.contains("position.x"))
            throw Error("scattering decals needs a depth pass under a pinhole camera, or a position pass");
        for (const char* name : {"position.x", "position.y", "position.z"}) position_.push_back(plane(planes, name));
    }

    std::optional<Surface> at(std::size_t i) const {
        Surface s{.position = {}, .normal = at(normal_, i)};
        const double length = s.normal.length();
        if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
        s.normal = direction(s.normal);
        V3d ray(0);
        if (rays_)
            ray = rays_->d0 + rays_->dx * (static_cast<double>(i % frame_.size.width) + 0.5) +
                  rays_->dy * (static_cast<double>(i / frame_.size.width) + 0.5);
        double depth = 0;
        if (!depth_.empty()) {
            depth = depth_[i];
            if (!(depth > 0 && depth < kBackgroundDepth)) return std::nullopt;
            if (frame_.ray_depth) depth /= ray.length();
            s.position = rays_->eye + depth * ray;
        } else {
            s.position = at(position_, i);
            if (!std::isfinite(s.position.length2())) return std::nullopt;
            if (rays_) depth = (s.position - rays_->eye).dot(ray) / ray.length2();
        }
        if (rays_) {
            s.pixel = depth * rays_->dx.length();
            if (s.normal.dot(ray) > 0) s.normal = -s.normal;
        }
        return s;
    }

    bool knows_pixel_size() const { return rays_.has_value(); }

private:
    struct Rays {
        V3d eye, d0, dx, dy;
    };

    static V3d at(const std::vector<std::span<const float>>& planes, std::size_t i) {
        return {planes[0][i], planes[1][i], planes[2][i]};
    }

    static std::span<const float> plane(const HostPlanes& planes, const char* name) {
        const auto found = planes.find(name);
        if (found == planes.end()) throw Error(std::string("scattering decals needs the plane ") + name);
        return found->second;
    }

    Frame frame_;
    std::optional<Rays> rays_;
    std::span<const float> depth_;
    std::vector<std::span<const float>> normal_, position_;
};

/// To the digits that tables need and no more, so that files stay small.
double rounded(double v) { return std::stod(fmt::format("{:.8g}", v)); }
Vec3 rounded(const V3d& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

/// Any unit vector perpendicular to n, turned by `angle` about it.
V3d tangent(const V3d& n, double angle) {
    const V3d a = direction((std::abs(n.z) < 0.9 ? V3d(0, 0, 1) : V3d(1, 0, 0)).cross(n));
    return a * std::cos(angle) + n.cross(a) * std::sin(angle);
}

}  // namespace

std::vector<Projector> scatter_decals(const ScatterOptions& options, const Frame& frame, const HostPlanes& planes) {
    const Pixels pixels(frame, planes);
    if (options.pixels && !pixels.knows_pixel_size())
        throw Error("sizes in pixels need a pinhole camera; give them in metres");
    Draw draw(options.seed);
    Spaced centers(options.spacing);
    std::vector<Projector> rows;
    const std::size_t count = std::size_t{frame.size.width} * frame.size.height;
    constexpr std::size_t kTries = 100;  // for each decal wanted; what fits after that is hardly worth the search
    for (std::size_t tries = 0; rows.size() < options.count && tries < kTries * options.count; ++tries) {
        const std::size_t i = draw.below(count);
        const std::optional<Surface> surface = pixels.at(i);
        if (!surface) continue;
        const V3d on_screen{static_cast<double>(i % frame.size.width), static_cast<double>(i / frame.size.width), 0};
        if (!centers.add(options.pixels ? on_screen : surface->position)) continue;
        Projector& row = rows.emplace_back();
        row.shape = options.shapes[draw.below(options.shapes.size())];
        row.texture = static_cast<std::uint32_t>(draw.below(options.textures));
        const double column = static_cast<double>(draw.below(options.atlas[0])), columns = options.atlas[0];
        const double line = static_cast<double>(draw.below(options.atlas[1])), lines = options.atlas[1];
        row.region = {column / columns, line / lines, (column + 1) / columns, (line + 1) / lines};
        row.center = rounded(surface->position);
        const V3d axis_x = tangent(surface->normal, draw.between(0, 2 * std::numbers::pi));
        row.axis_x = rounded(axis_x);
        row.axis_y = rounded(surface->normal.cross(axis_x));
        const double half =
            rounded(draw.between(options.half_size[0], options.half_size[1]) * (options.pixels ? surface->pixel : 1));
        row.half_size = {half, half, rounded(half * options.thickness)};
        if (row.shape == ProjectorShape::cone)  // the surface cuts it in the middle, where it is half as wide
            row.half_size = {2 * half, 2 * half, 2 * half};
        row.scale = rounded(half * options.depth);
        row.mode = options.mode;
        row.opacity = options.opacity;
    }
    bool shows_surface = !rows.empty();
    for (std::size_t i = 0; i < count && !shows_surface; ++i) shows_surface = pixels.at(i).has_value();
    if (!shows_surface)
        throw Error("no pixel of the frame shows a surface, with a normal and a depth or position, to place decals on");
    return rows;
}

}  // namespace wrinkle
