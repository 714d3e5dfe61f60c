#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <memory>
#include <string>

namespace wrinkle::io {

/// Opens an image for reading. Throws Error when the file is missing, a folder, empty, cut short or not an image, and
/// says which.
std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file, const OIIO::ImageSpec& options = {});

}  // namespace wrinkle::io
