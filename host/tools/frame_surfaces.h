#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/light_fit.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// Surfaces of a frame as its picture shows them, and what was known of them.
struct FrameSurfaces {
    std::vector<SeenSurface> surfaces;
    bool albedo = false;    ///< the frame has one; else it is taken for the scene's everywhere
    bool specular = false;  ///< what surfaces mirror was known, and left out
    std::string file;
};

constexpr std::uint32_t kAllRows = UINT32_MAX;

/// A few thousand pixels, drawn evenly over what the normals face, of at most so many bands of 64 rows, spread evenly.
/// Metal and what surfaces give off do not count. The same frame gives the same surfaces. Throws
/// Error where there are no normals or no picture.
FrameSurfaces surfaces_of_frame(const Scene& scene, int frame, std::uint32_t bands = kAllRows);

}  // namespace wrinkle
