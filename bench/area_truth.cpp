#include "area_truth.h"

#include <cmath>
#include <random>

#include "resident.h"
#include "tests/reference/evaluate.h"
#include "tests/reference/scene_images.h"

namespace wrinkle::bench {

namespace {

constexpr std::uint32_t kPoints = 32;  // of the truth, along each side of a pixel
constexpr int kColumns = 6;            // of pixels that have a truth

}  // namespace

Vectors own_normals(const AreaSurface& surface) {
    const BenchFrame frame = surface.frame(1);
    Vectors out;
    for (std::size_t i = 0; i < frame.pixels(); ++i)
        out.push_back({frame.planes.at("normal.x")[i], frame.planes.at("normal.y")[i], frame.planes.at("normal.z")[i]});
    return out;
}

AreaTruth::AreaTruth(const AreaSurface& surface, Scene scene) {
    for (Layer& layer : scene.layers) layer.footprint = false;
    const reference::Images images = reference::images_of(scene);
    const Vectors own = own_normals(surface);
    std::mt19937 random(kSeed);
    std::uniform_int_distribution<std::uint32_t> column(0, surface.size.width - 1);
    constexpr std::size_t count = std::size_t{kPoints} * kPoints;
    for (int k = 0; k < kColumns; ++k) {
        const std::uint32_t x = column(random);
        const BenchFrame points = surface.column(x, kPoints);
        reference::Planes planes;
        for (const auto& [name, plane] : points.planes) planes[name] = plane;
        const reference::SceneEvaluator<double> evaluator(scene, points.frame.size, points.frame.camera, planes,
                                                          images);
        for (std::uint32_t y = 0; y < surface.size.height; ++y) {
            const std::size_t pixel = std::size_t{y} * surface.size.width + x;
            std::array<double, 3> normal = own[pixel];
            bool whole = true;
            for (std::size_t i = 0; i < count && whole; ++i) {
                const auto at = evaluator.evaluate(y * count + i);
                whole = at.valid;
                normal[0] -= at.surface_gradient.x / count, normal[1] -= at.surface_gradient.y / count;
                normal[2] -= at.surface_gradient.z / count;
            }
            if (!whole) continue;
            pixels_.push_back(pixel);
            normals_.push_back(normal);
        }
    }
}

ErrorStats AreaTruth::compare(const Vectors& got) const {
    std::vector<double> degrees;
    for (std::size_t k = 0; k < pixels_.size(); ++k) {
        const auto &a = got[pixels_[k]], &b = normals_[k];
        degrees.push_back(angle_degrees({a[0], a[1], a[2]}, {b[0], b[1], b[2]}));
    }
    return statistics(std::move(degrees));
}

}  // namespace wrinkle::bench
