#include "tools/light_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "base/vec.h"
#include "tools/light_solver.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::size_t kFewest = 200, kOfGrid = 800;
constexpr int kTurns = 8;         // directions in which axes are turned
constexpr double kWeakest = 0.1;  // share of the strongest sun's light that another one has at least
constexpr double kDarkest = 0.5;  // share of what faces a further sun that it may miss: else it explains highlights
constexpr double kGain = 0.88;    // a further sun leaves this much of the cost or less, or there is none

/// An axis turned by an angle, in one of kTurns directions.
Vec3 turn(const Vec3& axis, double degrees, int direction) {
    const Vec3 side = normalize(cross(axis, std::abs(axis[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    const Vec3 other = cross(axis, side);
    const double angle = degrees * std::numbers::pi / 180, about = direction * 2 * std::numbers::pi / kTurns;
    Vec3 out{};
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = axis[k] * std::cos(angle) + (side[k] * std::cos(about) + other[k] * std::sin(about)) * std::sin(angle);
    return normalize(out);
}

/// Turns one axis after the other by ever smaller steps while that helps.
Fit refined(const LightSolver& solver, Fit best, double step, double finest) {
    while (step >= finest) {
        bool better = false;
        for (std::size_t axis = 0; axis < best.axes.count(); ++axis)
            for (int direction = 0; direction < kTurns; ++direction) {
                Axes turned = best.axes;
                turned.at(axis) = turn(turned.at(axis), step, direction);
                if (Fit other = solver.fit(turned); other.cost < best.cost) best = std::move(other), better = true;
            }
        if (!better) step /= 2;
    }
    return best;
}

/// How far a sun can turn before the cost rises by a hundredth.
double looseness(const LightSolver& solver, const Fit& best, std::size_t sun) {
    double loose = 0.25;
    for (double degrees = 0.5; degrees <= 64; degrees *= 2) {
        bool holds = false;
        for (int direction = 0; direction < kTurns && !holds; ++direction) {
            Axes turned = best.axes;
            turned.suns[sun] = turn(turned.suns[sun], degrees, direction);
            holds = solver.fit(turned).cost < best.cost + 0.01;
        }
        if (!holds) break;
        loose = degrees;
    }
    return loose;
}

/// Directions about 15 degrees apart, all around: a Fibonacci lattice.
std::vector<Vec3> grid() {
    constexpr int count = 180;
    std::vector<Vec3> directions;
    for (int i = 0; i < count; ++i) {
        const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z),
                     turn = i * std::numbers::pi * (3 - std::sqrt(5));
        directions.push_back({r * std::cos(turn), r * std::sin(turn), z});
    }
    return directions;
}

/// The best of fits with one more sun.
Fit with_sun(const LightSolver& solver, const Axes& axes) {
    std::optional<Fit> best;
    for (const Vec3& direction : grid()) {
        Axes more = axes;
        more.suns.push_back(direction);
        if (Fit other = solver.fit(more); !best || other.cost < best->cost) best = std::move(other);
    }
    return *best;
}

/// The light of the weakest sun, as a share of the strongest one's.
double weakest(const Fit& fit) {
    const auto suns = fit.colours.bottomRows(static_cast<Eigen::Index>(fit.axes.suns.size())).rowwise().sum().eval();
    return suns.minCoeff() / std::max(suns.maxCoeff(), 1e-30);
}

/// The share of the surfaces facing a sun that it does not reach.
double dark_share(const Fit& fit, std::span<const SeenSurface> surfaces, std::size_t sun) {
    double facing = 0, dark = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        if (dot(surfaces[i].normal, fit.axes.suns[sun]) < 0.1) continue;
        ++facing;
        if ((fit.lit[i] >> sun & 1) == 0) ++dark;
    }
    return facing > 0 ? dark / facing : 0;
}

void check_variety(std::span<const SeenSurface> surfaces) {
    if (surfaces.size() < kFewest)
        throw Error(
            fmt::format("lights cannot be fitted to {} pixels; it takes {} with a normal and a picture that is "
                        "not black",
                        surfaces.size(), kFewest));
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    const auto count = static_cast<double>(surfaces.size());
    for (const SeenSurface& s : surfaces) mean += Eigen::Vector3d(s.normal.data()) / count;
    for (const SeenSurface& s : surfaces) {
        const Eigen::Vector3d d = Eigen::Vector3d(s.normal.data()) - mean;
        spread += d * d.transpose() / count;
    }
    if (spread.trace() < 0.02)
        throw Error("lights cannot be fitted: all surfaces face the same way, so nothing tells where light is from");
}

}  // namespace

LightFit fit_lights(std::span<const SeenSurface> surfaces) {
    check_variety(surfaces);
    std::vector<SeenSurface> few;
    for (std::size_t i = 0; i < std::min(surfaces.size(), kOfGrid); ++i)
        few.push_back(surfaces[i * surfaces.size() / std::min(surfaces.size(), kOfGrid)]);
    const LightSolver coarse(few), fine(surfaces);
    if (!(fine.scale() > 0)) throw Error("lights cannot be fitted: the picture is black");
    std::optional<Fit> best;
    for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 1, 0}}) {  // where other programs have it
        const Fit dull = coarse.fit({up, {}});
        if (!best || dull.cost < best->cost) best = dull;
        if (Fit sunny = with_sun(coarse, {up, {}}); sunny.cost < kGain * std::min(dull.cost, best->cost)) best = sunny;
    }
    *best = refined(coarse, std::move(*best), 8, 1);
    while (!best->axes.suns.empty() && best->axes.suns.size() < kMostSuns) {
        Fit more = refined(coarse, with_sun(coarse, best->axes), 8, 2);
        if (!(more.cost < kGain * best->cost) || weakest(more) < kWeakest ||
            dark_share(more, few, more.axes.suns.size() - 1) > kDarkest)
            break;
        best = std::move(more);
    }
    *best = refined(fine, fine.fit(best->axes), 2, 0.25);

    LightFit out;
    out.surfaces = surfaces.size();
    Light sky{.kind = LightKind::sky, .up = best->axes.up};
    sky.zenith = colour_of(*best, 0, 1), sky.horizon = colour_of(*best, 1, 1), sky.ground = colour_of(*best, 2, 1);
    out.lights.push_back(sky);
    std::vector<std::size_t> order(best->axes.suns.size());
    std::iota(order.begin(), order.end(), 0);
    const auto strength = [&](std::size_t sun) {
        return best->colours.row(static_cast<Eigen::Index>(kSky + sun)).sum();
    };
    std::ranges::sort(order, std::greater{}, strength);
    for (const std::size_t sun : order) {
        const Vec3 irradiance = colour_of(*best, kSky + sun, std::numbers::pi), to = best->axes.suns[sun];
        const double most = *std::ranges::max_element(irradiance);
        if (!(most > 0)) continue;
        Light light{.kind = LightKind::sun, .intensity = most, .direction = {-to[0], -to[1], -to[2]}};
        for (std::size_t c = 0; c < 3; ++c) light.color[c] = irradiance[c] / most;
        out.lights.push_back(light);
        out.loose_degrees.push_back(looseness(coarse, coarse.fit(best->axes), sun));
        out.shadowed.push_back(dark_share(*best, surfaces, sun));
    }
    std::vector<double> off = best->off;
    std::ranges::sort(off);
    out.median = off[off.size() / 2] / fine.scale(), out.p90 = off[off.size() * 9 / 10] / fine.scale();
    return out;
}

}  // namespace wrinkle
