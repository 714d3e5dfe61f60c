#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/cryptomatte.h"
#include "io/frame_window.h"
#include "io/gbuffer_roles.h"
#include "io/metadata.h"
#include "io/object_ids.h"
#include "io/vector_source.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// How a channel's numbers are stored.
enum class ChannelType { half, single, whole };

/// The planes of one rendered frame, read in bands of rows.
///
/// A file may have several parts, be tiled, half or float. The frame is its display window, and with source.overscan
/// what data windows hold around it; pixels outside of a data window are zero, which is background. To be used by one
/// thread at a time; decompression uses several by itself, which works best with bands of 64 rows or more that begin at
/// multiples of 16 (the ZIP block).
class GBufferReader {
public:
    /// Opens `file` (the frame number already filled in); `source` gives role overrides and the depth's kind.
    /// Throws Error when it is missing, empty, no image, deep, or an override matches nothing.
    explicit GBufferReader(std::filesystem::path file, const GBufferSource& source = {});
    ~GBufferReader();
    GBufferReader(GBufferReader&&) noexcept;
    GBufferReader& operator=(GBufferReader&&) noexcept;

    const std::filesystem::path& path() const;
    Size size() const;  ///< the display window, and the overscan that is wanted
    const FrameWindow& window() const;
    /// Pixels of the frame along each side of a pixel of its beauty, which is read as if it had the frame's size.
    std::uint32_t beauty_scale() const;
    const std::vector<std::string>& beauty_channels() const;  ///< of the other file that the beauty is read from
    int parts() const;
    const std::vector<std::string>& channels() const;  ///< of all parts; channel X of a part named N is "N.X"
    const RoleMap& roles() const;                      ///< depth kind included: planar or ray
    bool packed_normals() const;                       ///< the file holds (n + 1) / 2; read_rows() undoes it
    const std::vector<std::string>& views() const;     ///< of a stereo file; the others' channels count as not there
    const std::string& view() const;                   ///< the one that is read
    double pixel_aspect() const;                       ///< width of a pixel by its height
    ChannelType channel_type(std::string_view channel) const;
    /// Rows that are compressed together, at most: reading one takes as long as reading all of them.
    std::uint32_t block_rows() const;
    /// How many such blocks may be read for a quick look at the frame, `most` at most. Frames of large blocks (many
    /// rows, many channels) allow fewer.
    std::uint32_t blocks_at_a_glance(std::uint32_t most) const;
    /// Rows to look at where a few have to do: at most 9, spread over the frame, the middle one first. Each costs a
    /// block of the file, once: looks that keep to these rows and the next ones share what was decompressed.
    std::vector<std::uint32_t> glance_rows() const;
    io::ObjectStorage object_storage() const;  ///< of the object role; the first call reads a few rows
    const Metadata& metadata() const;          ///< of all parts; where several have a value, the first part's

    /// Gives the world-to-camera matrix by which read_rows() turns camera-space normals into world space. Until then
    /// they are read as they are.
    void turn_normals(const Mat4& view);
    bool normals_are_in_world_space() const;

    /// Adds the planes NAME.x, NAME.y and NAME.z, vectors in world space; those of camera space need turn_normals().
    /// Throws Error naming the file when it cannot be read, has another size, or has no such channels.
    void add_vectors(const std::string& name, const io::VectorSource& source);

    /// "normal.x", "channel:NAME"; "beauty.a", the alpha beside the picture's colours; "bits:NAME" is a channel of
    /// integers, whose floats hold the integers' bits
    bool has_plane(std::string_view plane) const;
    bool has_role(std::string_view role) const { return roles().has_role(role); }
    std::vector<std::string> planes() const;  ///< of all roles that were found, and of vectors that were added

    /// Throws Error naming the role and the channels found when a plane has no channel.
    void require(std::span<const std::string> planes) const;

    const CryptomatteManifest& cryptomatte() const;  ///< of the cryptomatte that has the role; may be empty

    /// Has the system fetch the files of a frame that will be read later, without waiting for them.
    void read_ahead() const;

    /// Reads rows [row_begin, row_end), counted from the top, of planes[i] into out[i], which holds
    /// (row_end - row_begin) * width floats. Roles come in wrinkle's form: normals unpacked and in world space, object
    /// numbers as labels (io/object_ids.h), v upwards. Throws Error when a row cannot be read.
    void read_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const std::string> planes,
                   std::span<float* const> out) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Opens one frame of a sequence: fills its number into the names of the source.
GBufferReader open_gbuffer(const GBufferSource& source, int frame);

}  // namespace wrinkle
