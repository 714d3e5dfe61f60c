#include "tools/light_solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/median.h"
#include "base/vec.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

using Eigen::MatrixXd, Eigen::VectorXd;

constexpr std::size_t kUnknowns = kSky + kMostLamps;
using Terms = std::array<double, kUnknowns>;
constexpr int kRounds = 8;         // of weights and shadows; they settle in fewer
constexpr double kNearest = 0.02;  // of the radius: nearer to a point, light does not grow
constexpr std::size_t kFewestSurfaces = 200;
constexpr double kNoise = 0.06;  // of the median radiance: what is taken for noise

double square(double x) { return x * x; }

/// What a white surface shows of a sky whose zenith, horizon or ground alone is 1, by the cosine between its normal and
/// the sky's axis: the harmonics of order 2 of radiance that is linear in the sine of the elevation.
std::array<double, kSky> sky_terms(double t) {
    const double p2 = (3 * t * t - 1) / 2, rise = 0.25 + t / 3 + 5.0 / 64 * p2, horizon = (1 + t) / 2;
    return {rise, horizon - rise, (1 - t) / 2};
}

/// Solves normal equations for unknowns of 0 or more: those that come out below are left out, the lowest first.
VectorXd solve_not_negative(const MatrixXd& a, const VectorXd& b) {
    std::vector<Eigen::Index> kept(static_cast<std::size_t>(b.size()));
    std::iota(kept.begin(), kept.end(), 0);
    VectorXd x = VectorXd::Zero(b.size());
    while (!kept.empty()) {
        const VectorXd part = a(kept, kept).ldlt().solve(b(kept));
        Eigen::Index lowest = 0;
        if (part.minCoeff(&lowest) >= 0) {
            x(kept) = part;
            break;
        }
        kept.erase(kept.begin() + lowest);
    }
    return x;
}

/// The terms of a surface that some of the lamps reach: a bit each.
Terms lit_terms(Terms terms, unsigned lit) {
    for (std::size_t k = kSky; k < kUnknowns; ++k)
        if ((lit >> (k - kSky) & 1) == 0) terms[k] = 0;
    return terms;
}

/// The colours, by least squares of the surfaces in their light or shadow.
void solve(Fit& fit, std::span<const SeenSurface> surfaces, const std::vector<Terms>& terms,
           const std::vector<double>& weights) {
    const std::size_t unknowns = kSky + fit.axes.lamps.size();
    std::array<Terms, kUnknowns> a{};
    std::array<Vec3, kUnknowns> b{};
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Terms row = lit_terms(terms[i], fit.lit[i]);
        for (std::size_t j = 0; j < unknowns; ++j) {
            const double weighted = weights[i] * row[j];
            for (std::size_t k = j; k < unknowns; ++k) a[j][k] += weighted * row[k];
            for (std::size_t c = 0; c < 3; ++c) b[j][c] += weighted * surfaces[i].radiance[c];
        }
    }
    const auto size = static_cast<Eigen::Index>(unknowns);
    MatrixXd matrix(size, size), right(size, 3);
    for (std::size_t j = 0; j < unknowns; ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        for (std::size_t k = j; k < unknowns; ++k)
            matrix(row, static_cast<Eigen::Index>(k)) = matrix(static_cast<Eigen::Index>(k), row) = a[j][k];
        for (std::size_t c = 0; c < 3; ++c) right(row, static_cast<Eigen::Index>(c)) = b[j][c];
        matrix(row, row) += 1e-9 * static_cast<double>(surfaces.size());
    }
    for (Eigen::Index c = 0; c < 3; ++c) fit.colours.col(c) = solve_not_negative(matrix, right.col(c));
}

/// Of all ways in which the lamps reach a surface, the one that explains it best; and by how much that is off.
void choose_shadows(Fit& fit, std::span<const SeenSurface> surfaces, const std::vector<Terms>& terms) {
    const std::size_t unknowns = kSky + fit.axes.lamps.size();
    std::array<Vec3, kUnknowns> colours{};
    for (std::size_t k = 0; k < unknowns; ++k) colours[k] = colour_of(fit, k, 1);
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        double least = std::numeric_limits<double>::infinity();
        for (unsigned state = 1u << fit.axes.lamps.size(); state-- > 0;) {
            const Terms row = lit_terms(terms[i], state);
            Vec3 gap = surfaces[i].radiance;
            for (std::size_t k = 0; k < unknowns; ++k)
                for (std::size_t c = 0; c < 3; ++c) gap[c] -= row[k] * colours[k][c];
            if (const double sum = dot(gap, gap); sum < least)
                least = sum, fit.lit[i] = static_cast<std::uint8_t>(state);
        }
        fit.off[i] = std::sqrt(least);
    }
}

}  // namespace

void check_variety(std::span<const SeenSurface> surfaces) {
    if (surfaces.size() < kFewestSurfaces)
        throw Error(
            fmt::format("lights cannot be fitted to {} pixels; it takes {} with a normal and a picture that is "
                        "not black",
                        surfaces.size(), kFewestSurfaces));
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

Vec3 colour_of(const Fit& fit, std::size_t row, double factor) {
    Vec3 out{};
    for (std::size_t c = 0; c < 3; ++c)
        out[c] = factor * fit.colours(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(c));
    return out;
}

LightSolver::LightSolver(std::span<const SeenSurface> surfaces) : surfaces_(surfaces) {
    std::vector<double> sizes, distances;
    for (const SeenSurface& s : surfaces) sizes.push_back(std::sqrt(dot(s.radiance, s.radiance)));
    scale_ = median(sizes);
    if (!std::ranges::all_of(surfaces, [](const SeenSurface& s) { return s.place.has_value(); })) return;
    for (std::size_t c = 0; c < 3; ++c) {
        std::vector<double> axis;
        for (const SeenSurface& s : surfaces) axis.push_back((*s.place)[c]);
        extent_.middle[c] = median(axis);
    }
    for (const SeenSurface& s : surfaces) {
        const Vec3 gap = subtract(*s.place, extent_.middle);
        distances.push_back(std::sqrt(dot(gap, gap)));
    }
    extent_.radius = median(distances);
}

double LightSolver::term(const SeenSurface& surface, const Lamp& lamp) const {
    if (!lamp.point) return std::max(dot(surface.normal, lamp.at), 0.0);
    const Vec3 gap = subtract(lamp.at, *surface.place);
    const double distance2 = std::max(dot(gap, gap), square(kNearest * extent_.radius));
    return std::max(dot(surface.normal, gap), 0.0) * square(extent_.radius) / (distance2 * std::sqrt(distance2));
}

Fit LightSolver::fit(const Axes& axes) const {
    const std::size_t lamps = axes.lamps.size(), count = surfaces_.size();
    Fit out{axes, MatrixXd::Zero(static_cast<Eigen::Index>(kSky + lamps), 3), std::vector<double>(count),
            std::vector<std::uint8_t>(count, static_cast<std::uint8_t>((1u << lamps) - 1)), 0};
    std::vector<Terms> terms(count);
    for (std::size_t i = 0; i < count; ++i) {
        const auto sky = sky_terms(dot(surfaces_[i].normal, axes.up));
        std::ranges::copy(sky, terms[i].begin());
        for (std::size_t k = 0; k < lamps; ++k) terms[i][kSky + k] = term(surfaces_[i], axes.lamps[k]);
    }
    std::vector<double> weights(count, 1.0);
    for (int round = 0; round < kRounds; ++round) {
        solve(out, surfaces_, terms, weights);
        choose_shadows(out, surfaces_, terms);
        for (std::size_t i = 0; i < count; ++i) weights[i] = 1 / (1 + square(out.off[i] / (kNoise * scale_)));
    }
    for (const double off : out.off) out.cost += std::log1p(square(off / (kNoise * scale_)));
    out.cost /= static_cast<double>(count);
    return out;
}

}  // namespace wrinkle
