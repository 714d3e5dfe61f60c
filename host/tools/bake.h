#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "io/volume_file.h"
#include "wrinkle/device.h"

/// Volumes and frames made from formulas on the device's lanes: test data that needs no renderer and whose answers are
/// known exactly.
namespace wrinkle {

enum class BakedVolume {
    noise,            ///< three octaves of Perlin noise where they are positive: a fog in [0, 1] x [0, 1] x [0, 1]
    golden,           ///< level set of the golden-ratio surface within 5.3 of the origin, half width 3 voxels
    golden_gradient,  ///< vectors: the gradient of its implicit function there
};

/// A grid of about size^3 voxels. Throws Error where they would not fit into the memory that may be taken.
DenseVolume bake_volume(const Device& device, BakedVolume kind, int size);

/// The golden-ratio surface, within 5.2 of the origin, seen by a pinhole camera: depth (planar), position.* and
/// normal.* (unit, exact but for their rounding), as rendered frames have them: depth 1e10, the rest 0, where there is
/// nothing. Needs a device with double precision. Gives rows [row_begin, row_end), counted from the top, as the points
/// of large frames would take 160 bytes a pixel at once.
std::map<std::string, std::vector<float>> bake_golden_rows(const Device& device, const Camera& camera, Size size,
                                                           std::uint32_t row_begin, std::uint32_t row_end);

}  // namespace wrinkle
