#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/frame_window.h"
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
    std::string lossy{};  ///< the compression, where floats come back changed
};

/// One part of the file. Its data window may be smaller than the frame.
struct Part {
    int x = 0, y = 0, width = 0, height = 0;  ///< data window, relative to the frame's first pixel
    int origin_x = 0, origin_y = 0;           ///< of the data window in the file's own coordinates
    int channels = 0;                         ///< all that are stored
    int tile_height = 0;                      ///< 0 when the part is stored by scanlines
    int block_rows = 1;      ///< that are compressed together: reading one of them takes as long as all
    double block_bytes = 0;  ///< of those rows, with all channels of the part, uncompressed
};

/// The flat parts of an image file and the channels in them, as far as they belong to the view that is read.
struct ImageParts {
    Size size;  ///< of the frame: the display window, and the overscan around it where that is wanted
    FrameWindow window;
    std::vector<Part> parts;
    std::vector<ChannelPlace> channels;
    std::vector<std::string> views;  ///< that the file has; empty without any
    std::string view;                ///< the one that is read
    Metadata metadata;
};

/// What of a file is a frame.
struct FrameExtent {
    std::string view{};     ///< empty: the file's default one
    bool overscan = false;  ///< data around the display window belongs to the frame
};

/// Lists the parts. Throws Error for deep or empty ones, for parts
/// of different frames, and for a view that the file has not.
ImageParts list_parts(OIIO::ImageInput& input, const std::filesystem::path& file, const FrameExtent& extent = {});

}  // namespace wrinkle::io
