#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "io/band_reader.h"
#include "io/image_parts.h"
#include "io/vector_source.h"

namespace wrinkle::io {

/// The vectors of a frame's pixels that three channels hold, the frame's own or another file's.
class VectorPlanes {
public:
    /// `frame` is that of `frame_file`. Throws Error naming the file when it cannot be read, has another size, or has
    /// no such channels.
    VectorPlanes(const VectorSource& source, const ImageParts& frame, const std::filesystem::path& frame_file,
                 bool overscan);

    const ChannelPlace& place(std::size_t axis) const { return places_[axis]; }
    /// Of the other file; null: the frame's own reads them.
    BandReader* reader() const { return reader_.get(); }
    bool camera_space() const { return camera_space_; }

private:
    std::array<ChannelPlace, 3> places_;
    std::unique_ptr<BandReader> reader_;
    bool camera_space_;
};

/// The memory of NAME.x, NAME.y and NAME.z, of `count` numbers each, where `out` holds that of `planes`; nothing where
/// none of them is wanted. Throws Error, with `file` in front, where only some are.
std::optional<std::array<std::span<float>, 3>> vector_memory(const std::string& name,
                                                             std::span<const std::string> planes,
                                                             std::span<float* const> out, std::size_t count,
                                                             const std::filesystem::path& file);

}  // namespace wrinkle::io
