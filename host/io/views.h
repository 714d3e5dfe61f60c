#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace wrinkle::io {

/// The views of a stereo file, and which of them is read. Views are never mixed: what belongs to another one counts as
/// not there.
struct Views {
    std::vector<std::string> names;       ///< the file's default first; empty: the file has no views
    std::string chosen;                   ///< empty without views
    std::vector<std::string> part_views;  ///< of each part; empty: the part belongs to all of them
    bool by_prefix = false;               ///< within a part, channels name their view, as in "right.N.X"

    /// Whether a channel of a part belongs to the chosen view; if so, `channel` loses the view's name.
    bool take(std::size_t part, std::string& channel) const;
    /// A part's name without its view: "N" for "N.main"; empty for "left".
    std::string without_view(std::size_t part, const std::string& name) const;
};

/// Finds the views by the attributes `view` (of parts) and `multiView` (of channels), else by parts or channels that
/// are called left and right. `wanted`: the one to read; empty: the default. Throws Error when the file has no such
/// view.
Views find_views(const std::vector<OIIO::ImageSpec>& parts, const std::string& wanted,
                 const std::filesystem::path& file);

}  // namespace wrinkle::io
