#pragma once

#include <string>

#include "io/texture_file.h"

namespace wrinkle::io {

/// Why a texture looks as if its texels meant something else than `use` says; empty: it does not. `image` is what
/// load_bump() made of it. Normals are judged by their lengths and directions, heights by whether the file is a picture
/// in colour. Nothing is refused: a map may look odd and be meant so.
std::string texture_doubt(const TextureUse& use, const Image& image);

}  // namespace wrinkle::io
