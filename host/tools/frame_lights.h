#pragma once

#include "tools/light_fit.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// Lights that are fitted to a frame, and by what.
struct FrameLights {
    LightFit fit;
    bool albedo = false;    ///< the frame has one; else it is taken for the scene's everywhere
    bool specular = false;  ///< what surfaces mirror was known, and left out
};

/// Fits lights to a frame of a scene by its picture, normals and albedo, at a few thousand pixels drawn evenly over
/// what the normals face; metal, what is left alone and what surfaces give off do not count. The same frame gives the
/// same lights. Throws Error where there are no normals or no picture, or the frame tells too little.
FrameLights lights_of_frame(const Scene& scene, int frame);

/// Whether a scene wants its picture relit and names no light that could do it.
bool wants_lights(const Scene& scene);
/// The scene with such lights, whose shadows are read off the picture, and a line that says what they are.
Scene with_lights(Scene scene, const FrameLights& lights);
std::string summary(const FrameLights& lights);
/// The lights as [[light]] tables, with comments that say how well they fit.
std::string lights_as_toml(const FrameLights& lights);

}  // namespace wrinkle
