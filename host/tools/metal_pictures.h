#pragma once

#include <memory>
#include <vector>

#include "wrinkle/scene.h"

namespace wrinkle {

using MetalPictures = std::shared_ptr<const std::vector<MetalPicture>>;

/// Whether metal of a scene's frames is looked for, to be relit by what it mirrors: by "ratio" and with bumps, unless
/// the scene has its pictures.
bool wants_metals(const Scene& scene);

/// What the metals of a frame mirror by the direction, read off its picture: of up to three objects, those with the
/// most pixels. Left out are objects of few pixels, and those that show less than a quarter of all directions, as what
/// is flat: where their bumps would mirror, nothing is known. A frame without metal is told by some of its rows.
/// Nothing where the frame lacks normals, a picture, a pinhole camera, or what tells metal: its pass, or an albedo of
/// 0.
///   before   those of the frame before in a sequence: the same objects are taken, and one that is not to be seen keeps
///            what it has, so that metals do not come and go
/// Throws Error where the frame cannot be read.
MetalPictures metals_of_frame(const Scene& scene, int frame, const MetalPictures& before = {});

/// The scene with metals, if there are some.
Scene with_metals(Scene scene, const MetalPictures& metals);

}  // namespace wrinkle
