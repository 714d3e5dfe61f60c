#include "tools/scatter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <ranges>
#include <unordered_map>

#include "base/vec.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

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
    bool add(const Vec3& p) {
        if (distance_ <= 0) return true;
        std::array<std::int64_t, 3> cell{};
        for (std::size_t k = 0; k < 3; ++k) cell[k] = static_cast<std::int64_t>(std::floor(p[k] / distance_));
        for (std::int64_t i = 0; i < 27; ++i) {
            const auto found = cells_.find(key({cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1}));
            if (found == cells_.end()) continue;
            for (const Vec3& other : found->second)
                if (const Vec3 d = subtract(p, other); dot(d, d) < distance_ * distance_) return false;
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
    std::unordered_map<std::uint64_t, std::vector<Vec3>> cells_;
};

/// The surface at a pixel.
struct Surface {
    Vec3 position, normal;
    double pixel = 0;  ///< metres of a pixel that faces the viewer
};

class Pixels {
public:
    Pixels(const Frame& frame, const HostPlanes& planes)
        : frame_(frame), rays_(pinhole_rays(frame.camera, frame.size)) {
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
        Surface s;
        for (std::size_t k = 0; k < 3; ++k) s.normal[k] = normal_[k][i];
        const double length = std::sqrt(dot(s.normal, s.normal));
        if (!(length > 0) || !std::isfinite(length)) return std::nullopt;
        s.normal = normalize(s.normal);
        Vec3 ray{};
        for (std::size_t k = 0; rays_ && k < 3; ++k)
            ray[k] = rays_->d0[k] + rays_->dx[k] * (static_cast<double>(i % frame_.size.width) + 0.5) +
                     rays_->dy[k] * (static_cast<double>(i / frame_.size.width) + 0.5);
        double depth = 0;
        if (!depth_.empty()) {
            depth = depth_[i];
            if (!(depth > 0 && depth < 1e9)) return std::nullopt;
            if (frame_.ray_depth) depth /= std::sqrt(dot(ray, ray));
            for (std::size_t k = 0; k < 3; ++k) s.position[k] = rays_->eye[k] + depth * ray[k];
        } else {
            for (std::size_t k = 0; k < 3; ++k) s.position[k] = position_[k][i];
            if (!std::isfinite(dot(s.position, s.position))) return std::nullopt;
            if (rays_) depth = dot(subtract(s.position, rays_->eye), ray) / dot(ray, ray);
        }
        if (rays_) {
            s.pixel = depth * std::sqrt(dot(rays_->dx, rays_->dx));
            if (dot(s.normal, ray) > 0) s.normal = {-s.normal[0], -s.normal[1], -s.normal[2]};
        }
        return s;
    }

    bool knows_pixel_size() const { return rays_.has_value(); }

private:
    static std::span<const float> plane(const HostPlanes& planes, const char* name) {
        const auto found = planes.find(name);
        if (found == planes.end()) throw Error(std::string("scattering decals needs the plane ") + name);
        return found->second;
    }

    Frame frame_;
    std::optional<PinholeRays> rays_;
    std::span<const float> depth_;
    std::vector<std::span<const float>> normal_, position_;
};

/// To the digits that tables need and no more, so that files stay small.
double rounded(double v) { return std::stod(fmt::format("{:.8g}", v)); }
Vec3 rounded(const Vec3& v) { return {rounded(v[0]), rounded(v[1]), rounded(v[2])}; }

/// Any unit vector perpendicular to n, turned by `angle` about it.
Vec3 tangent(const Vec3& n, double angle) {
    const Vec3 a = normalize(cross(std::abs(n[2]) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, n)), b = cross(n, a);
    const double c = std::cos(angle), s = std::sin(angle);
    return {a[0] * c + b[0] * s, a[1] * c + b[1] * s, a[2] * c + b[2] * s};
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
        const Vec3 on_screen{static_cast<double>(i % frame.size.width), static_cast<double>(i / frame.size.width), 0};
        if (!centers.add(options.pixels ? on_screen : surface->position)) continue;
        Projector& row = rows.emplace_back();
        row.shape = options.shapes[draw.below(options.shapes.size())];
        row.texture = static_cast<std::uint32_t>(draw.below(options.textures));
        const double column = static_cast<double>(draw.below(options.atlas[0])), columns = options.atlas[0];
        const double line = static_cast<double>(draw.below(options.atlas[1])), lines = options.atlas[1];
        row.region = {column / columns, line / lines, (column + 1) / columns, (line + 1) / lines};
        row.center = rounded(surface->position);
        const Vec3 axis_x = tangent(surface->normal, draw.between(0, 2 * std::numbers::pi));
        row.axis_x = rounded(axis_x);
        row.axis_y = rounded(cross(surface->normal, axis_x));
        const double half =
            rounded(draw.between(options.half_size[0], options.half_size[1]) * (options.pixels ? surface->pixel : 1));
        row.half_size = {half, half, rounded(half * options.thickness)};
        if (row.shape == ProjectorShape::cone)  // the surface cuts it in the middle, where it is half as wide
            row.half_size = {2 * half, 2 * half, 2 * half};
        row.scale = rounded(half * options.depth);
        row.mode = options.mode;
        row.opacity = options.opacity;
    }
    const auto shows_surface = [&](std::size_t i) { return pixels.at(i).has_value(); };
    if (rows.empty() && std::ranges::none_of(std::views::iota(std::size_t{0}, count), shows_surface))
        throw Error("no pixel of the frame shows a surface, with a normal and a depth or position, to place decals on");
    return rows;
}

}  // namespace wrinkle
