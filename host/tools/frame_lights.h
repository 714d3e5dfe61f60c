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
/// what the normals face; metal and what surfaces give off do not count. The same frame gives the
/// same lights. Throws Error where there are no normals or no picture, or the frame tells too little.
FrameLights lights_of_frame(const Scene& scene, int frame);

/// What a frame's picture tells of lights that the scene does not.
struct FoundLights {
    std::optional<FrameLights> all{};   ///< the scene names none
    std::optional<LightScale> named{};  ///< it names them, in some unit
    std::string why_not{};              ///< it names them, and the picture does not tell how strong they are
};

/// Whether a scene wants its picture relit, and names no light that could do it, or up to three suns, points and
/// spheres, with Shadows::automatic and without pictures of their own, whose shadows could be read if their unit were
/// known.
bool wants_lights(const Scene& scene);
/// What such a scene wants, from a frame. Throws as lights_of_frame() does where it names no lights.
FoundLights find_lights(const Scene& scene, int frame);
/// The scene with lights in the picture's units, whose shadows are read off it, and a line that says what was found.
Scene with_lights(Scene scene, const FoundLights& found);
std::string summary(const FoundLights& found);
std::string summary(const FrameLights& lights);
/// The lights as [[light]] tables, with comments that say how well they fit.
std::string lights_as_toml(const FrameLights& lights);

}  // namespace wrinkle
