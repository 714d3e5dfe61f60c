#include "error.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/reference/evaluate.h"
#include "tests/reference/scene_images.h"

namespace wrinkle::bench {

ReferenceSample::ReferenceSample(const Scene& scene, const BenchFrame& frame, std::size_t count, std::uint32_t seed) {
    const reference::Images images = reference::images_of(scene);
    reference::Planes planes;
    for (const auto& [name, plane] : frame.planes) planes[name] = plane;
    const reference::SceneEvaluator<double> evaluator(scene, frame.frame.size, frame.frame.camera, planes, images);
    std::mt19937 random(seed);
    std::uniform_int_distribution<std::size_t> pick(0, frame.pixels() - 1);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t i = pick(random);
        const auto e = evaluator.evaluate(i);
        if (e.valid) pixels_.push_back({i, e.normal.x, e.normal.y, e.normal.z});
    }
}

ErrorStats ReferenceSample::compare(const Normals& normals) const {
    std::vector<double> degrees;
    for (const Pixel& want : pixels_) {
        const double x = normals.x[want.i], y = normals.y[want.i], z = normals.z[want.i];
        const double cx = y * want.z - z * want.y, cy = z * want.x - x * want.z, cz = x * want.y - y * want.x;
        degrees.push_back(std::atan2(std::hypot(cx, cy, cz), x * want.x + y * want.y + z * want.z) * 57.29577951308232);
    }
    return statistics(std::move(degrees));
}

}  // namespace wrinkle::bench
