#include "io/surface_check.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "base/imath.h"
#include "base/median.h"
#include "io/background.h"

namespace wrinkle::io {
namespace {

using Imath::V3d;

constexpr std::uint32_t kColumns = 256;  // pixels of a row, about
constexpr std::uint32_t kLongest = 8;    // pixels between the corners of a quad: further than jitter and rounding reach
constexpr std::size_t kFewest = 64;      // quads, to judge by
constexpr double kDegrees = 180 / std::numbers::pi;

/// What four pixels show: the normal that is stored and the one of the plane through their points, facing the viewer.
struct Quad {
    V3d stored, spanned, to_viewer;
};

/// Nothing where the two triangles of a quad disagree: at an edge, or where points are scattered.
std::optional<V3d> spanned_normal(const V3d (&corner)[4], const V3d& to_viewer) {
    constexpr double flat = 0.94;  // 20 degrees
    const V3d first = direction((corner[1] - corner[0]).cross(corner[2] - corner[0]));
    const V3d second = direction((corner[3] - corner[2]).cross(corner[3] - corner[1]));
    if (!(std::abs(first.dot(second)) > flat)) return std::nullopt;
    const V3d normal = direction(first.dot(second) > 0 ? first + second : first - second);
    return normal.dot(to_viewer) < 0 ? -normal : normal;
}

/// The planes of some rows, read once.
class Rows {
public:
    Rows(const GBufferReader& reader, std::vector<std::string> planes)
        : reader_(reader), planes_(std::move(planes)), values_(planes_.size()) {}

    void read(std::uint32_t first, std::uint32_t count) {
        std::vector<float*> out;
        for (auto& plane : values_) {
            plane.resize(std::size_t{count} * reader_.size().width);
            out.push_back(plane.data());
        }
        reader_.read_rows(first, first + count, planes_, out);
    }
    V3d vector(std::size_t plane, std::size_t pixel) const {
        return {values_[plane][pixel], values_[plane + 1][pixel], values_[plane + 2][pixel]};
    }
    double number(std::size_t plane, std::size_t pixel) const { return values_[plane][pixel]; }

private:
    const GBufferReader& reader_;
    std::vector<std::string> planes_;
    std::vector<std::vector<float>> values_;
};

bool is_finite(const V3d& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// A frame's points in the world: from its position pass, or from depth.
class Points {
public:
    Points(const Camera& camera, Size size, bool positions, bool ray)
        : rays_(pinhole_rays(camera, size)), positions_(positions), ray_(ray) {
        if (rays_) {
            eye_ = to_imath(rays_->eye), d0_ = to_imath(rays_->d0);
            dx_ = to_imath(rays_->dx), dy_ = to_imath(rays_->dy);
            return;
        }
        // A parallel camera: pixels are places, and all look along one direction.
        const auto& w = camera.proj[3];
        parallel_ = w[0] == 0 && w[1] == 0 && w[2] == 0;
        if (!parallel_) return;
        const Imath::M44d to_world = to_imath(inverse(camera.view)), to_view = to_imath(inverse(camera.proj));
        const auto seen_at = [&](double x, double y) {
            V3d at = V3d(2 * x / size.width - 1, 1 - 2 * y / size.height, 0) * to_view;
            at.z = 0;
            return at * to_world;
        };
        d0_ = seen_at(0, 0), dx_ = seen_at(1, 0) - d0_, dy_ = seen_at(0, 1) - d0_;
        to_world.multDirMatrix(V3d(0, 0, 1), backwards_);
    }
    bool possible() const { return rays_ || parallel_; }
    V3d to_viewer(const V3d& from) const { return rays_ ? direction(eye_ - from) : backwards_; }

    std::optional<V3d> at(const Rows& rows, std::size_t pixel, double x, double y) const {
        constexpr std::size_t geometry = 3;  // planes after the normal's
        if (positions_) {
            const V3d p = rows.vector(geometry, pixel);
            return is_finite(p) && p != V3d(0) ? std::optional(p) : std::nullopt;
        }
        const double depth = rows.number(geometry, pixel);
        if (!(depth > 0 && depth < kBackgroundDepth)) return std::nullopt;
        const V3d ray = d0_ + x * dx_ + y * dy_;
        return parallel_ ? ray - depth * backwards_ : eye_ + depth * (ray_ ? direction(ray) : ray);
    }

private:
    std::optional<PinholeRays> rays_;
    V3d eye_{0}, d0_{0}, dx_{0}, dy_{0}, backwards_{0};
    bool positions_, ray_, parallel_ = false;
};

std::vector<Quad> sample_quads(const GBufferReader& reader, const Points& points, bool positions) {
    std::vector<Quad> quads;
    const auto [width, height] = reader.size();
    const std::uint32_t side = std::clamp(std::min(width, height) / 32, 1u, kLongest), rows_read = side + 1;
    if (width <= side || height <= side) return quads;
    std::vector<std::string> planes{"normal.x", "normal.y", "normal.z"};
    if (positions)
        planes.insert(planes.end(), {"position.x", "position.y", "position.z"});
    else
        planes.emplace_back("depth");
    Rows rows(reader, planes);
    for (const std::uint32_t middle : reader.glance_rows()) {
        const std::uint32_t first = std::min(middle - middle % 16, height - rows_read);
        rows.read(first, rows_read);
        for (std::uint32_t x = 0; x + side < width; x += std::max(width / kColumns, 1u)) {
            V3d corner[4], stored(0);
            bool whole = true;
            for (std::uint32_t k = 0; k < 4 && whole; ++k) {
                const std::uint32_t column = x + (k % 2) * side, row = (k / 2) * side;
                const std::size_t pixel = std::size_t{row} * width + column;
                const V3d normal = rows.vector(0, pixel);
                const auto point = points.at(rows, pixel, column + 0.5, first + row + 0.5);
                whole = point && is_finite(normal) && normal != V3d(0);
                if (!whole) break;
                corner[k] = *point;
                stored += normal;
            }
            if (!whole) continue;
            const V3d to_viewer = points.to_viewer(corner[0]);
            if (const auto spanned = spanned_normal(corner, to_viewer))
                quads.push_back({stored / 4, *spanned, to_viewer});
        }
    }
    return quads;
}

double median_angle(const std::vector<Quad>& quads, const std::function<V3d(const V3d&)>& meant) {
    std::vector<double> angles;
    for (const Quad& quad : quads)
        angles.push_back(std::acos(std::clamp(direction(meant(quad.stored)).dot(quad.spanned), -1.0, 1.0)) * kDegrees);
    return median(std::move(angles));
}

/// A way in which normals may be meant that are not what they should be.
struct Meaning {
    std::function<V3d(const V3d&)> meant;
    const char* what;
};

std::vector<Meaning> meanings(const Camera& camera) {
    const auto turned = [view = camera.view](const V3d& n) {
        V3d world(0);
        for (int k = 0; k < 3; ++k) world[k] = view[0][k] * n.x + view[1][k] * n.y + view[2][k] * n.z;
        return world;
    };
    return {
        {turned, "they fit as normals in camera space: [gbuffer] normals = \"camera\""},
        {[turned](const V3d& n) {
             return turned({n.x, n.y, -n.z});
         },
         "they fit as normals in camera space whose z grows away from the viewer: turn that z, and say normals = "
         "\"camera\""},
        {[](const V3d& n) { return V3d(n.x, -n.z, n.y); }, "they fit with y up, where the geometry has z up: turn one"},
        {[](const V3d& n) { return V3d(n.x, n.z, -n.y); }, "they fit with z up, where the geometry has y up: turn one"},
        {[](const V3d& n) { return -n; }, "they fit turned inside out: negate them"},
        {[](const V3d& n) { return 2.0 * n - V3d(1); }, "they fit as (n + 1) / 2: [gbuffer] normals = \"packed\""},
        {[turned](const V3d& n) { return turned(2.0 * n - V3d(1)); },
         "they fit as (n + 1) / 2 in camera space: unpack them, and say normals = \"camera\""},
    };
}

}  // namespace

std::string normals_misfit(const GBufferReader& reader, const Camera& camera) {
    constexpr double far_off = 35, fits = 20;
    const bool positions = reader.has_role("position");
    if (!reader.has_role("normal") || (!positions && !reader.has_role("depth"))) return {};
    const auto as_they_are = [&](const V3d& n) {
        return reader.normals_are_in_world_space() ? n : meanings(camera).front().meant(n);
    };
    std::vector<Quad> quads;
    double off = 0;
    for (const bool ray : {false, true}) {  // which of both depths are is not known here, and matters little
        const Points points(camera, reader.size(), positions, ray);
        if (!points.possible()) return {};
        quads = sample_quads(reader, points, positions);
        if (quads.size() < kFewest) return {};
        off = median_angle(quads, as_they_are);
        if (positions || off <= far_off) break;
    }
    if (off <= far_off) return {};
    std::string reason = "are they in world space, and of this frame?";
    double best = fits;
    for (const Meaning& meaning : meanings(camera)) {
        const double angle = median_angle(quads, meaning.meant);
        if (angle >= best) continue;
        best = angle, reason = meaning.what;
    }
    return fmt::format(
        "the normals ({}) do not fit the surface that {} shows: half of them are off by {:.0f} degrees or more; {}",
        reader.roles().channel_of.find("normal.x")->second,
        positions ? "the position pass" : "depth, seen by this camera,", off, reason);
}

std::string depth_misfit(const GBufferReader& reader) {
    if (reader.has_role("position") || !reader.has_role("depth") || !reader.has_role("normal")) return {};
    const std::uint32_t width = reader.size().width;
    Rows rows(reader, {"normal.x", "normal.y", "normal.z", "depth"});
    std::size_t surface = 0, none = 0, negative = 0;
    bool normalised = true;
    for (const std::uint32_t row : reader.glance_rows()) {
        rows.read(row, 1);
        for (std::uint32_t x = 0; x < width; ++x) {
            const double depth = rows.number(3, x);
            normalised = normalised && depth >= 0 && depth <= 1;
            const V3d normal = rows.vector(0, x);
            if (!is_finite(normal) || normal == V3d(0)) continue;
            ++surface;
            none += !(depth > 0 && depth < kBackgroundDepth);
            negative += depth < 0;
        }
    }
    if (surface < kFewest) return {};
    const std::string& channel = reader.roles().channel_of.find("depth")->second;
    if (2 * none > surface)
        return fmt::format(
            "depth ({}) is {} for {:.0f}% of the pixels that have a normal: it has to be the distance from the eye in "
            "metres",
            channel, 2 * negative > surface ? "negative" : "no distance",
            100 * static_cast<double>(none) / static_cast<double>(surface));
    if (normalised)
        return fmt::format(
            "depth ({}) lies between 0 and 1 everywhere, also in the background: is it normalised? It has to be the "
            "distance from the eye in metres",
            channel);
    return {};
}

}  // namespace wrinkle::io
