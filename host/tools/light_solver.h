#pragma once

#include <Eigen/Dense>
#include <cstdint>

#include "tools/light_fit.h"

namespace wrinkle {

/// Where the light of a lamp comes from: a direction, of unit length, or a point.
struct Lamp {
    Vec3 at;
    bool point = false;
};

/// What a fit tries: the sky's axis, and the lamps.
struct Axes {
    Vec3 up{0, 0, 1};
    std::vector<Lamp> lamps;
};

/// Where surfaces are: their middle, and how far half of them are from it at most.
struct Extent {
    Vec3 middle{};
    double radius = 0;  ///< 0: nobody knows where they are
};

/// A fit with given axes.
struct Fit {
    Axes axes;
    Eigen::MatrixXd colours;        ///< a row an unknown: the sky's, then the lamps' radiances on white, of points ...
                                    ///< ... at the distance of one radius
    std::vector<double> off;        ///< of each surface: the length of what is unexplained
    std::vector<std::uint8_t> lit;  ///< of each surface: a bit a lamp that reaches it
    double cost = 0;
};

constexpr std::size_t kMostLamps = 3;
constexpr std::size_t kSky = 3;  ///< unknowns of the sky: zenith, horizon, ground

/// Throws Error where surfaces are too few, or face too much the same way, to tell where light is from.
void check_variety(std::span<const SeenSurface> surfaces);

/// A row of a fit's colours, times a factor.
Vec3 colour_of(const Fit& fit, std::size_t row, double factor);

/// Fits colours of lights with given axes to surfaces, robustly.
class LightSolver {
public:
    explicit LightSolver(std::span<const SeenSurface> surfaces);

    double scale() const { return scale_; }  ///< the median radiance
    const Extent& extent() const { return extent_; }
    std::span<const SeenSurface> surfaces() const { return surfaces_; }

    /// What a white surface shows of a lamp whose colour is 1 and that reaches it.
    double term(const SeenSurface& surface, const Lamp& lamp) const;

    /// The cost is the mean of log(1 + (off / noise)^2): what is far off costs little more than what is off.
    Fit fit(const Axes& axes) const;

private:
    std::span<const SeenSurface> surfaces_;
    double scale_ = 0;
    Extent extent_;
};

}  // namespace wrinkle
