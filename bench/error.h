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

/// Reference normals of a scene at a seeded sample of valid pixels; errors are angles in degrees; the reference is
/// written from the papers (tests/reference).
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
