#pragma once

#include <array>
#include <vector>

#include "wrinkle/camera.h"

namespace wrinkle {

/// A picture of all directions, folded out to a square: the octahedron that the z axis runs through, its upper half in
/// the middle, its lower one in the corners [Cigolle et al. 2014]. As wr_octahedral.
struct OctahedralMap {
    using Texel = std::array<float, 3>;

    explicit OctahedralMap(int texels)
        : size(texels), all(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels)) {}

    int size;                ///< texels along each side
    std::vector<Texel> all;  ///< row by row

    /// Texel (x, y); x and y from -1 to size: beyond an edge the picture goes on at the same edge, turned around.
    const Texel& at(int x, int y) const;
    /// Bilinear, of a unit vector.
    Texel sample(const Vec3& direction) const;
    /// The same picture with half as many texels along each side, each the mean of 2 x 2.
    OctahedralMap half() const;

    /// The unit vector at a place of the square [0,1]^2, and the place of a vector.
    static Vec3 direction(double s, double t);
    static std::array<double, 2> place(const Vec3& direction);
};

}  // namespace wrinkle
