#include "scene/files.h"

#include <fmt/format.h>

#include <system_error>

#include "base/limits.h"
#include "io/frame_path.h"
#include "io/udim.h"

namespace wrinkle::scene {
namespace fs = std::filesystem;

std::string why_not_readable(const fs::path& file, bool pattern, const char* from) {
    std::error_code error;
    if (!may_be_allowed(file)) return "it lies outside of the folder that files may be read from";
    const fs::file_status status = fs::status(file, error);
    if (fs::is_directory(status)) return fmt::format("{} is a folder, not a file", file.string());
    if (fs::exists(status)) return {};
    if (io::is_udim(file))
        return io::udim_tiles(file).empty()
                   ? fmt::format("there is no tile of {}, as 1001 in place of <UDIM>", file.string())
                   : std::string{};
    if (!has_frame_pattern(file))
        return fmt::format("there is no file {} (relative paths start from {})", file.string(), from);
    if (!pattern)
        return fmt::format("{} holds a place for a frame number, and none is given (--frames, --frame)", file.string());
    const fs::path folder = file.parent_path();
    if (folder.empty() || fs::is_directory(folder, error)) return {};
    return fmt::format("there is no folder {}", folder.string());
}

}  // namespace wrinkle::scene
