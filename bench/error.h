#pragma once

#include <cstdint>
#include <string>

#include "error_stats.h"
#include "frame.h"

namespace wrinkle::bench {

/// Normals of one contender, plane by plane.
struct Normals {
    std::vector<float> x, y, z;
    explicit Normals(std::size_t pixels) : x(pixels), y(pixels), z(pixels) {}
};

/// The right normals of a scene at some of its valid pixels, drawn by a seed, by the double-precision reference of
/// tests/reference. Errors are angles in degrees.
class ReferenceSample {
public:
    ReferenceSample(const Scene& scene, const BenchFrame& frame, std::size_t count, std::uint32_t seed);
    ErrorStats compare(const Normals& normals) const;

private:
    struct Pixel {
        std::size_t i;
        double x, y, z;
    };
    std::vector<Pixel> pixels_;
};

}  // namespace wrinkle::bench
