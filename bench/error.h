#pragma once

#include <cstdint>
#include <string>

#include "frame.h"

namespace wrinkle::bench {

/// Angle between normals and the double reference, degrees, over a seeded sample of valid pixels.
struct ErrorStats {
    double median = 0, p99 = 0, max = 0;
    std::size_t samples = 0, not_finite = 0;
};

/// Normals of one contender, plane by plane.
struct Normals {
    std::vector<float> x, y, z;
    explicit Normals(std::size_t pixels) : x(pixels), y(pixels), z(pixels) {}
};

/// Reference normals of a scene at sampled pixels; the reference is written from the papers (tests/reference).
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
