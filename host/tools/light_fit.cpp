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

constexpr std::size_t kOfGrid = 800;
constexpr int kTurns = 8;         // directions in which axes are turned
constexpr double kWeakest = 0.1;  // share of the strongest lamp's light that another one has at least
constexpr double kDarkest = 0.5;  // share of what faces a further lamp that it may miss: else it explains highlights
constexpr double kGain = 0.88;    // a further lamp leaves this much of the cost or less, or there is none
constexpr double kNear = 0.95;    // ... and a point this much of what a sun in its place leaves
constexpr double kFar = 12;       // radii from the middle of the surfaces; points further off are suns

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

/// What lies a step of some degrees around a lamp; of a point as seen from the middle of the surfaces, and nearer and
/// further.
std::vector<Lamp> around(const Lamp& lamp, const Extent& extent, double degrees) {
    std::vector<Lamp> all;
    if (!lamp.point) {
        for (int direction = 0; direction < kTurns; ++direction) all.push_back({turn(lamp.at, degrees, direction)});
        return all;
    }
    const Vec3 from = subtract(lamp.at, extent.middle);
    const double step = degrees * std::numbers::pi / 180 * std::max(std::sqrt(dot(from, from)), extent.radius / 4);
    const auto add = [&](const Vec3& way) {
        for (const double sign : {-step, step}) {
            Vec3 at = lamp.at;
            for (std::size_t c = 0; c < 3; ++c) at[c] += sign * way[c];
            all.push_back({at, true});
        }
    };
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) add(axis);
    if (dot(from, from) > 0) add(normalize(from));
    return all;
}

/// Turns the sky's axis by ever smaller steps while that helps, and moves one lamp after the other where they may move.
Fit refined(const LightSolver& solver, Fit best, double step, double finest, bool lamps_move = true) {
    while (step >= finest) {
        bool better = false;
        const auto try_axes = [&](const Axes& axes) {
            if (Fit other = solver.fit(axes); other.cost < best.cost) best = std::move(other), better = true;
        };
        for (int direction = 0; direction < kTurns; ++direction) {
            Axes turned = best.axes;
            turned.up = turn(turned.up, step, direction);
            try_axes(turned);
        }
        for (std::size_t k = 0; lamps_move && k < best.axes.lamps.size(); ++k)
            for (const Lamp& lamp : around(best.axes.lamps[k], solver.extent(), step)) {
                Axes moved = best.axes;
                moved.lamps[k] = lamp;
                try_axes(moved);
            }
        if (!better) step /= 2;
    }
    return best;
}

/// How far a lamp can turn, in degrees, or move, in metres, before the cost rises by a hundredth.
double looseness(const LightSolver& solver, const Fit& best, std::size_t k) {
    const Lamp& lamp = best.axes.lamps[k];
    double loose = 0.25;
    for (double degrees = 0.5; degrees <= 64; degrees *= 2) {
        const std::vector<Lamp> moved = around(lamp, solver.extent(), degrees);
        const bool holds = std::ranges::any_of(moved, [&](const Lamp& other) {
            Axes axes = best.axes;
            axes.lamps[k] = other;
            return solver.fit(axes).cost < best.cost + 0.01;
        });
        if (!holds) break;
        loose = degrees;
    }
    if (!lamp.point) return loose;
    const Vec3 step = subtract(around(lamp, solver.extent(), loose).front().at, lamp.at);
    return std::sqrt(dot(step, step));
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

/// Places in and around the surfaces, in shells of directions.
std::vector<Vec3> places(const Extent& extent) {
    std::vector<Vec3> all;
    if (!(extent.radius > 0)) return all;
    const std::vector<Vec3> directions = grid();
    for (const double radii : {0.35, 0.8, 1.5, 3.0})
        for (std::size_t i = radii < 1 ? 1 : 0; i < directions.size(); i += radii < 1 ? 4 : 2) {
            all.push_back(extent.middle);
            for (std::size_t c = 0; c < 3; ++c) all.back()[c] += radii * extent.radius * directions[i][c];
        }
    return all;
}

/// The best of fits with one more lamp; a point only where it is better by far, as a distant one is a sun.
Fit with_lamp(const LightSolver& solver, const Axes& axes) {
    std::optional<Fit> sun, point;
    const auto best_of = [&](std::optional<Fit>& best, const Lamp& lamp) {
        Axes more = axes;
        more.lamps.push_back(lamp);
        if (Fit other = solver.fit(more); !best || other.cost < best->cost) best = std::move(other);
    };
    for (const Vec3& direction : grid()) best_of(sun, {direction});
    for (const Vec3& place : places(solver.extent())) best_of(point, {place, true});
    *sun = refined(solver, std::move(*sun), 8, 4);
    if (!point) return *sun;
    *point = refined(solver, std::move(*point), 16, 4);
    const Vec3 gap = subtract(point->axes.lamps.back().at, solver.extent().middle);
    const bool far = dot(gap, gap) > kFar * kFar * solver.extent().radius * solver.extent().radius;
    return !far && point->cost < kNear * sun->cost ? *point : *sun;
}

/// The light on all surfaces together of a lamp whose colour is 1.
double reach(const LightSolver& solver, const Lamp& lamp) {
    double sum = 0;
    for (const SeenSurface& surface : solver.surfaces()) sum += solver.term(surface, lamp);
    return sum;
}

/// A lamp's light on all surfaces together.
double strength(const LightSolver& solver, const Fit& fit, std::size_t k) {
    return reach(solver, fit.axes.lamps[k]) * fit.colours.row(static_cast<Eigen::Index>(kSky + k)).sum();
}

/// A lamp's power, W/m2 or W/sr, where its radiance on white is 1.
double unit_of(const Lamp& lamp, const Extent& extent) {
    return std::numbers::pi * (lamp.point ? extent.radius * extent.radius : 1);
}

Light sky_of(const Fit& fit) {
    Light sky{.kind = LightKind::sky, .up = fit.axes.up};
    sky.zenith = colour_of(fit, 0, 1), sky.horizon = colour_of(fit, 1, 1), sky.ground = colour_of(fit, 2, 1);
    return sky;
}

/// What is off by more than a share of the surfaces are, as a share of the median radiance.
double unexplained(const LightSolver& solver, const Fit& fit, double share) {
    std::vector<double> off = fit.off;
    std::ranges::sort(off);
    return off[std::min(static_cast<std::size_t>(share * static_cast<double>(off.size())), off.size() - 1)] /
           solver.scale();
}

/// The light of the weakest lamp, as a share of the strongest one's.
double weakest(const LightSolver& solver, const Fit& fit) {
    std::vector<double> all;
    for (std::size_t k = 0; k < fit.axes.lamps.size(); ++k) all.push_back(strength(solver, fit, k));
    const auto [least, most] = std::ranges::minmax(all);
    return least / std::max(most, 1e-30);
}

/// The share of the surfaces facing a lamp that it does not reach.
double dark_share(const LightSolver& solver, const Fit& fit, std::size_t k) {
    const std::span<const SeenSurface> surfaces = solver.surfaces();
    const Lamp& lamp = fit.axes.lamps[k];
    double facing = 0, dark = 0;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Vec3 to = lamp.point ? normalize(subtract(lamp.at, *surfaces[i].place)) : lamp.at;
        if (dot(surfaces[i].normal, to) < 0.1) continue;
        ++facing;
        if ((fit.lit[i] >> k & 1) == 0) ++dark;
    }
    return facing > 0 ? dark / facing : 0;
}

}  // namespace

LightFit fit_lights(std::span<const SeenSurface> surfaces) {
    check_variety(surfaces);
    std::vector<SeenSurface> few;
    for (std::size_t i = 0; i < std::min(surfaces.size(), kOfGrid); ++i)
        few.push_back(surfaces[i * surfaces.size() / std::min(surfaces.size(), kOfGrid)]);
    const LightSolver coarse(few), fine(surfaces);
    if (!(fine.scale() > 0)) throw Error("lights cannot be fitted: the picture is black");
    // Other programs have z or y up.
    Fit z = coarse.fit({{0, 0, 1}, {}}), y = coarse.fit({{0, 1, 0}, {}});
    Fit best = z.cost <= y.cost ? z : y;
    Fit sunny = with_lamp(coarse, best.axes);
    if (Fit other = coarse.fit({z.cost <= y.cost ? y.axes.up : z.axes.up, sunny.axes.lamps}); other.cost < sunny.cost)
        sunny = std::move(other);
    if (sunny.cost < kGain * best.cost) best = std::move(sunny);
    best = refined(coarse, std::move(best), 8, 1);
    while (!best.axes.lamps.empty() && best.axes.lamps.size() < kMostLamps) {
        Fit more = refined(coarse, with_lamp(coarse, best.axes), 8, 2);
        if (!(more.cost < kGain * best.cost) || weakest(coarse, more) < kWeakest ||
            dark_share(coarse, more, more.axes.lamps.size() - 1) > kDarkest)
            break;
        best = std::move(more);
    }
    best = refined(fine, fine.fit(best.axes), 2, 0.25);

    LightFit out;
    out.surfaces = surfaces.size();
    out.lights.push_back(sky_of(best));
    std::vector<std::size_t> order(best.axes.lamps.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, std::greater{}, [&](std::size_t k) { return strength(fine, best, k); });
    for (const std::size_t k : order) {
        const Lamp& lamp = best.axes.lamps[k];
        const Vec3 power = colour_of(best, kSky + k, unit_of(lamp, fine.extent()));
        const double most = *std::ranges::max_element(power);
        if (!(most > 0)) continue;
        Light light{.kind = lamp.point ? LightKind::point : LightKind::sun, .intensity = most};
        if (lamp.point)
            light.position = lamp.at;
        else
            light.direction = {-lamp.at[0], -lamp.at[1], -lamp.at[2]};
        for (std::size_t c = 0; c < 3; ++c) light.color[c] = power[c] / most;
        out.lights.push_back(light);
        out.loose.push_back(looseness(coarse, coarse.fit(best.axes), k));
        out.shadowed.push_back(dark_share(fine, best, k));
    }
    out.median = unexplained(fine, best, 0.5), out.p90 = unexplained(fine, best, 0.9);
    return out;
}

LightScale fit_scale(std::span<const SeenSurface> surfaces, std::span<const Light> lamps) {
    check_variety(surfaces);
    const LightSolver solver(surfaces);
    if (!(solver.scale() > 0)) throw Error("the strength of lights cannot be told: the picture is black");
    Axes axes;
    for (const Light& light : lamps) {
        const bool point = light.kind != LightKind::sun;
        if (point && !(solver.extent().radius > 0)) throw Error("where surfaces are is not known");
        axes.lamps.push_back(point ? Lamp{light.position, true} : Lamp{normalize(subtract({}, light.direction))});
    }
    // Other programs have z or y up.
    const Fit z = solver.fit(axes);
    axes.up = {0, 1, 0};
    const Fit y = solver.fit(axes);
    const Fit best = refined(solver, z.cost <= y.cost ? z : y, 8, 1, false);
    std::vector<double> found, named;
    double shown = 0, all = 0;
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        const Lamp& lamp = best.axes.lamps[k];
        const Vec3& color = lamps[k].color;
        found.push_back(strength(solver, best, k));
        named.push_back(reach(solver, lamp) * lamps[k].intensity * (color[0] + color[1] + color[2]) /
                        unit_of(lamp, solver.extent()));
        const double one = best.colours.row(static_cast<Eigen::Index>(kSky + k)).sum();
        for (std::size_t i = 0; i < surfaces.size(); ++i)
            if (best.lit[i] >> k & 1) shown += one * solver.term(surfaces[i], lamp);
    }
    for (const SeenSurface& s : surfaces) all += s.radiance[0] + s.radiance[1] + s.radiance[2];
    const auto sum = [](const std::vector<double>& v) { return std::accumulate(v.begin(), v.end(), 0.0); };
    LightScale out{.scale = sum(found) / sum(named), .share = shown / all, .sky = sky_of(best)};
    out.median = unexplained(solver, best, 0.5);
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        const double own = found[k] / named[k] / out.scale;
        // What is weak beside the others is found to no more than its place in the noise.
        if (std::max(found[k], out.scale * named[k]) > kWeakest * sum(found))
            out.apart = std::max({out.apart, own, 1 / own});
    }
    return out;
}

}  // namespace wrinkle
