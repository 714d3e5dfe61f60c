#include "io/residual.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/background.h"

namespace wrinkle {
namespace {

constexpr std::uint32_t samples_per_row = 256;

/// The value that a share of all values lie below.
double quantile(std::vector<double>& values, double share) {
    const auto index = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5);
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
    return values[index];
}

bool is_surface(const PositionSample& sample) {
    const auto& p = sample.position;
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) return false;
    if (!std::isnan(sample.depth)) return sample.depth > 0 && sample.depth < kBackgroundDepth;
    return p != Vec3{0, 0, 0};
}

/// Medians of the relative errors of depths, taken as planar ones and as distances. Nothing without depths.
std::optional<std::pair<double, double>> depth_errors(const Camera& camera, std::span<const PositionSample> samples) {
    std::vector<double> planar, ray;
    for (const auto& [x, y, p, depth] : samples) {
        if (std::isnan(depth)) continue;
        Vec3 view{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& row = camera.view[i];
            view[i] = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
        }
        planar.push_back(std::abs(-view[2] / depth - 1));
        ray.push_back(std::abs(std::hypot(view[0], view[1], view[2]) / depth - 1));
    }
    if (planar.empty()) return std::nullopt;
    return std::pair{quantile(planar, 0.5), quantile(ray, 0.5)};
}

}  // namespace

std::vector<PositionSample> sample_positions(const GBufferReader& reader) {
    std::vector<PositionSample> samples, by_normal_alone;
    if (!reader.has_role("position")) return samples;
    const auto [width, height] = reader.size();
    const bool with_depth = reader.has_role("depth"), with_normal = reader.has_role("normal");
    std::vector<std::string> planes{"position.x", "position.y", "position.z"};
    if (with_normal)
        for (const char* name : {"normal.x", "normal.y", "normal.z"}) planes.emplace_back(name);
    if (with_depth) planes.emplace_back("depth");
    // Rows are read in neighbouring pairs: both lie in one compressed block, so the second costs nothing.
    std::vector<std::vector<float>> values(planes.size(), std::vector<float>(std::size_t{2} * width));
    std::vector<float*> out;
    for (auto& plane : values) out.push_back(plane.data());

    const auto step = std::max(width / samples_per_row, 1u);
    for (const std::uint32_t glanced : reader.glance_rows()) {
        const auto row = glanced - glanced % 2, row_end = std::min(row + 2, height);
        reader.read_rows(row, row_end, planes, out);
        for (std::uint32_t pixel = step / 2; pixel < (row_end - row) * width; pixel += step) {
            const PositionSample sample{pixel % width + 0.5 + reader.window().x,
                                        row + pixel / width + 0.5 + reader.window().y,
                                        {values[0][pixel], values[1][pixel], values[2][pixel]},
                                        with_depth ? values.back()[pixel] : std::numeric_limits<double>::quiet_NaN()};
            // In a sample a NaN depth means that the frame has no depth at all. A NaN in the plane is a hole: no
            // sample.
            if (with_depth && std::isnan(sample.depth)) continue;
            const auto normal_length = [&] { return std::hypot(values[3][pixel], values[4][pixel], values[5][pixel]); };
            if (with_normal && !(normal_length() > 0)) continue;  // background, which may have any position
            if (is_surface(sample))
                samples.push_back(sample);
            else if (with_normal &&
                     is_surface({sample.x, sample.y, sample.position, std::numeric_limits<double>::quiet_NaN()}))
                by_normal_alone.push_back(sample);
        }
    }
    return samples.empty() ? by_normal_alone : samples;
}

Residual reprojection_residual(const Camera& camera, Size size, std::span<const PositionSample> samples) {
    if (samples.empty()) return {};
    std::vector<double> distances;
    for (const auto& sample : samples) {
        const auto pixel = project(camera, size, sample.position);
        distances.push_back(pixel ? std::hypot((*pixel)[0] - sample.x, (*pixel)[1] - sample.y)
                                  : std::numeric_limits<double>::infinity());
    }
    return {quantile(distances, 0.5), quantile(distances, 0.99), distances.size()};
}

std::optional<DepthKind> measure_depth_kind(const Camera& camera, std::span<const PositionSample> samples) {
    constexpr double fits = 1e-3;  // largest relative error; half floats and filtering stay below it
    constexpr double clearly = 4;  // so many times better than the other kind it must fit
    const auto errors = depth_errors(camera, samples);
    if (!errors) return std::nullopt;
    const auto [planar, ray] = *errors;
    if (planar < fits && clearly * planar < ray) return DepthKind::planar;
    if (ray < fits && clearly * ray < planar) return DepthKind::ray;
    return std::nullopt;
}

double depth_misfit(const Camera& camera, std::span<const PositionSample> samples) {
    const auto errors = depth_errors(camera, samples);
    return errors ? std::min(errors->first, errors->second) : 0;
}

}  // namespace wrinkle
