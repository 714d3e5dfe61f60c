#pragma once

#include <Eigen/Dense>
#include <cstdint>

#include "tools/light_fit.h"

namespace wrinkle {

/// The normalised axes that a fit tries: the sky's, and those towards the suns.
struct Axes {
    Vec3 up{0, 0, 1};
    std::vector<Vec3> suns;

    Vec3& at(std::size_t i) { return i == 0 ? up : suns[i - 1]; }
    std::size_t count() const { return 1 + suns.size(); }
};

/// A fit with given axes.
struct Fit {
    Axes axes;
    Eigen::MatrixXd colours;        ///< a row an unknown: the sky's, then the suns' radiances on white
    std::vector<double> off;        ///< of each surface: the length of what is unexplained
    std::vector<std::uint8_t> lit;  ///< of each surface: a bit a sun that reaches it
    double cost = 0;
};

constexpr std::size_t kMostSuns = 3;
constexpr std::size_t kSky = 3;  ///< unknowns of the sky: zenith, horizon, ground

/// A row of a fit's colours, times a factor.
Vec3 colour_of(const Fit& fit, std::size_t row, double factor);

/// Fits colours of lights with given axes to surfaces, robustly.
class LightSolver {
public:
    explicit LightSolver(std::span<const SeenSurface> surfaces);

    double scale() const { return scale_; }  ///< the median radiance

    /// The cost is the mean of log(1 + (off / noise)^2): what is far off costs little more than what is off.
    Fit fit(const Axes& axes) const;

private:
    std::span<const SeenSurface> surfaces_;
    double scale_ = 0;
};

}  // namespace wrinkle
