#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/metadata.h"
#include "wrinkle/camera.h"

namespace wrinkle::io {

/// Where in a file a channel is.
struct ChannelPlace {
    std::string name;
    std::string stored_name;  ///< its name within its part
    int part = 0, index = 0;
    bool whole_numbers = false;  ///< EXR UINT: read as the number itself, not as a share of 2^32
    bool half = false;
};

/// One part of the file. Its data window may be smaller or larger than the frame.
struct Part {
    int x = 0, y = 0, width = 0, height = 0;  ///< data window, relative to the frame's top left pixel
    int origin_x = 0, origin_y = 0;           ///< of the data window in the file's own coordinates
    int tile_height = 0;                      ///< 0 when the part is stored by scanlines
};

/// The flat parts of an image file and the channels in them.
struct ImageParts {
    Size size;  ///< display window
    std::vector<Part> parts;
    std::vector<ChannelPlace> channels;
    Metadata metadata;
};

/// Lists the parts. Throws Error for deep or empty ones and for parts of different frames.
ImageParts list_parts(OIIO::ImageInput& input, const std::filesystem::path& file);

}  // namespace wrinkle::io
