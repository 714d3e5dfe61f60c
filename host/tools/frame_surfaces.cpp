#include "tools/frame_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <random>

#include "base/imath.h"
#include "base/vec.h"
#include "resources/octahedral_map.h"
#include "run/open_frame.h"
#include "tools/frame_rows.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::uint32_t kRows = 64;  // read at a time
constexpr int kCells = 12;           // of normals along each of two axes of the octahedron
constexpr std::size_t kMost = 4000;  // pixels, together
constexpr float kDark = 0.02f;       // an albedo below this divides noise, and may be metal's
constexpr float kMetallic = 0.1f;

/// The cell of a unit normal on the octahedron, unfolded into a square.
int cell_of(const Vec3& n) {
    const auto cell = [](double v) { return std::clamp(static_cast<int>(v * kCells), 0, kCells - 1); };
    const auto [s, t] = OctahedralMap::place(n);
    return cell(t) * kCells + cell(s);
}

/// Draws as many from every cell, each surface of a cell with the same chance, by a seed of its own.
class EvenDraw {
public:
    void add(const SeenSurface& surface) {
        Cell& cell = cells_[cell_of(surface.normal)];
        ++cell.seen;
        if (cell.drawn.size() < kOfCell) return cell.drawn.push_back(surface);
        if (const std::size_t at = std::uniform_int_distribution<std::size_t>(0, cell.seen - 1)(random_); at < kOfCell)
            cell.drawn[at] = surface;
    }
    /// In an order without a pattern.
    std::vector<SeenSurface> take() {
        std::vector<SeenSurface> all;
        const std::size_t each = std::clamp<std::size_t>(kMost / std::max<std::size_t>(cells_.size(), 1), 1, kOfCell);
        for (auto& [number, cell] : cells_) {
            std::ranges::shuffle(cell.drawn, random_);
            const std::size_t count = std::min(cell.drawn.size(), each);
            all.insert(all.end(), cell.drawn.begin(), cell.drawn.begin() + static_cast<std::ptrdiff_t>(count));
        }
        std::ranges::shuffle(all, random_);
        return all;
    }

private:
    static constexpr std::size_t kOfCell = 200;
    struct Cell {
        std::size_t seen = 0;
        std::vector<SeenSurface> drawn;
    };
    std::map<int, Cell> cells_;
    std::mt19937_64 random_{1};
};

/// Where pixels are in the world: by their depth as a pinhole camera sees it, or as the frame says; else nobody knows.
class Places {
public:
    Places(const ReadRows& rows, const Frame& frame, Geometry geometry)
        : rows_(rows), width_(frame.size.width), ray_depth_(frame.ray_depth) {
        const bool by_position = geometry == Geometry::position && rows.has("position.x");
        if (frame.planes.contains("depth") && !by_position) rays_ = pinhole_rays(frame.camera, frame.size);
    }

    /// Of pixel i of rows that begin with `first`.
    std::optional<Vec3> at(std::size_t i, std::uint32_t first) const {
        if (!rays_) {
            if (!rows_.has("position.x")) return {};
            return rows_.vec("position", "xyz", i);
        }
        const double x = static_cast<double>(i % width_) + 0.5, y = static_cast<double>(first + i / width_) + 0.5;
        const Imath::V3d along = to_imath(rays_->d0) + x * to_imath(rays_->dx) + y * to_imath(rays_->dy);
        const double depth = rows_.at("depth", i);
        return to_array(to_imath(rays_->eye) + depth * (ray_depth_ ? direction(along) : along));
    }

private:
    const ReadRows& rows_;
    std::size_t width_;
    bool ray_depth_;
    std::optional<PinholeRays> rays_;
};

/// What a pixel shows as a surface; nothing where it shows none that tells of lights.
std::optional<SeenSurface> surface_at(const ReadRows& rows, std::size_t i, const Vec3& albedo_of_scene) {
    SeenSurface out{rows.vec("normal", "xyz", i), rows.vec("beauty", "rgb", i)};
    const double length = std::sqrt(dot(out.normal, out.normal));
    if (!(length > 0.5) || !std::isfinite(length)) return {};  // filtered away, or background
    for (double& x : out.normal) x /= length;
    if (rows.has("metallic") && !(rows.at("metallic", i) < kMetallic)) return {};
    const Vec3 albedo = rows.has("albedo.r") ? rows.vec("albedo", "rgb", i) : albedo_of_scene;
    std::array<Vec3, 3> others{};
    std::size_t k = 0;
    for (const char* part : {"emission", "transmission", "specular"}) others[k++] = rows.part(part, i);
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(albedo[c] > kDark)) return {};
        for (const Vec3& other : others) out.radiance[c] -= other[c];
        out.radiance[c] = std::max(out.radiance[c], 0.0) / albedo[c];
        if (!std::isfinite(out.radiance[c])) return {};
    }
    return out;
}

bool is_finite(const Vec3& v) {
    return std::ranges::all_of(v, [](double x) { return std::isfinite(x); });
}

}  // namespace

FrameSurfaces surfaces_of_frame(const Scene& scene, int frame, std::uint32_t bands) {
    GBufferReader reader = open_frame(scene, frame);
    for (const char* role : {"normal", "beauty"})
        if (!reader.has_role(role))
            throw Error(fmt::format("{}: lights are fitted by the frame's picture and normals; it has no {}",
                                    reader.path().string(), role));
    const FrameCamera camera = camera_of_frame(scene, reader, frame);  // turns normals that are in its space
    ReadRows rows(reader, {"depth", "position", "normal", "beauty", "albedo", "metallic", "emission", "transmission",
                           "transmission_direct", "transmission_indirect", "transmission_color", "specular",
                           "specular_direct", "specular_indirect", "specular_color"});
    const Places places(rows, frame_of(scene, reader, camera), scene.gbuffer.geometry);
    EvenDraw draw;
    const std::uint32_t height = reader.size().height, tall = (height + kRows - 1) / kRows,
                        every = (tall + std::min(bands, tall) - 1) / std::max(std::min(bands, tall), 1u) * kRows;
    for (std::uint32_t first = 0; first < height; first += every) {
        const std::size_t count = rows.read(first, std::min(first + kRows, height));
        for (std::size_t i = 0; i < count; ++i)
            if (auto surface = surface_at(rows, i, scene.lighting.albedo)) {
                surface->place = places.at(i, first);
                if (!surface->place || is_finite(*surface->place)) draw.add(*surface);
            }
    }
    return {draw.take(), rows.has("albedo.r"), rows.has("specular.r") || rows.has_parts("specular"),
            reader.path().string()};
}

}  // namespace wrinkle
