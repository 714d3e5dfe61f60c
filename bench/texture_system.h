#pragma once

#include <memory>

#include "frame.h"
#include "wrinkle/textures.h"

namespace wrinkle::bench {

inline constexpr double kGroundRepeat =
    1.8;  ///< metres after which texture coordinates of measure_area's ground repeat

/// The slopes of a texture over the ground of measure_area, by OpenImageIO's TextureSystem: 16-fold anisotropic, from
/// the same finest slopes, whose mips are made as `maketx --filter box` does, on all cores.
class TextureSystemSlopes {
public:
    /// `scale`: the surface gradient that a slope of 1 makes. The frame has depths and texture coordinates.
    TextureSystemSlopes(const TextureUse& use, double scale, const BenchFrame& frame);
    ~TextureSystemSlopes();
    TextureSystemSlopes(TextureSystemSlopes&&) noexcept;

    void run();
    /// Of the ground, whose own normal is z.
    std::vector<std::array<double, 3>> normals() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace wrinkle::bench
