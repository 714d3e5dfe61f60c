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
/// A file may have several parts, be tiled, half or float. The frame is its display window; pixels outside of the data
/// window are zero, which is background. To be used by one thread at a time; decompression uses several by itself,
/// which works best with bands of 64 rows or more that begin at multiples of 16 (the ZIP block).
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
    const std::vector<std::string>& channels() const;  ///< of all parts; channel X of a part named N is "N.X"
    const RoleMap& roles() const;                      ///< depth kind included: planar or ray
    bool packed_normals() const;                       ///< the file holds (n + 1) / 2; read_rows() undoes it
    const Metadata& metadata() const;                  ///< of all parts; where several have a value, the first part's

    bool has_plane(std::string_view plane) const;  ///< "normal.x", "channel:NAME"
    bool has_role(std::string_view role) const { return roles().has_role(role); }
    std::vector<std::string> planes() const;  ///< the planes of all roles that were found

    /// Throws Error naming the role and the channels found when a plane has no channel.
    void require(std::span<const std::string> planes) const;

    const CryptomatteManifest& cryptomatte() const;  ///< of the cryptomatte that has the role; may be empty

    /// Reads rows [row_begin, row_end), counted from the top, of planes[i] into out[i], which holds
    /// (row_end - row_begin) * width floats. Throws Error when a row cannot be read.
    void read_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const std::string> planes,
                   std::span<float* const> out) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace wrinkle
