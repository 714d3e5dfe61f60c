#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <string>

namespace wrinkle::io {

/// Opens an image for reading. Throws Error saying which of these it is: missing, a folder, empty, or not an image.
std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file, const OIIO::ImageSpec& options = {});

}  // namespace wrinkle::io
