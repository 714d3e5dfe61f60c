#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/cryptomatte.h"
#include "io/gbuffer_roles.h"
#include "io/metadata.h"
#include "wrinkle/camera.h"
#include "wrinkle/scene.h"

namespace wrinkle {

/// The planes of one rendered frame, read in bands of rows.
///
/// A file may have several parts, be tiled, half or float; its frame is the display window, and pixels outside the data
/// window are zero (background). One thread at a time; OpenImageIO decompresses on several by itself, best with bands
/// of 64 rows or more that begin at multiples of 16 (the ZIP block).
class GBufferReader {
public:
    /// Opens `file` (the frame number already filled in); `source` gives role overrides and the depth's kind.
    /// Throws Error when it is missing, empty, no image, deep, or an override matches nothing.
    explicit GBufferReader(std::filesystem::path file, const GBufferSource& source = {});
    ~GBufferReader();
    GBufferReader(GBufferReader&&) noexcept;
    GBufferReader& operator=(GBufferReader&&) noexcept;

    const std::filesystem::path& path() const;
    Size size() const;
    int parts() const;
    const std::vector<std::string>& channels() const;  ///< of all parts; bare names of named parts as "part.X"
    const RoleMap& roles() const;                      ///< depth kind included: planar or ray
    bool packed_normals() const;                       ///< the file holds (n + 1) / 2; read_rows() undoes it
    const Metadata& metadata() const;                  ///< of all parts, the first part's value where several have one

    bool has_plane(std::string_view plane) const;  ///< "normal.x", "channel:NAME"
    bool has_role(std::string_view role) const { return roles().has_role(role); }
    std::vector<std::string> planes() const;  ///< mapped planes, without "channel:NAME"

    /// Throws Error naming the role and the channels found when a plane has no channel.
    void require(std::span<const std::string> planes) const;

    const CryptomatteManifest& cryptomatte() const;  ///< of the cryptomatte in use; may be empty

    /// Rows [row_begin, row_end), counted from the top, of each plane into out[i], which holds
    /// (row_end - row_begin) * width floats. Throws Error when a row cannot be read.
    void read_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const std::string> planes,
                   std::span<float* const> out) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle
