#include "scene/files.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <system_error>

#include "io/frame_path.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace fs = std::filesystem;

std::string why_not_readable(const fs::path& file, bool pattern, const char* from) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (fs::is_directory(status)) return fmt::format("{} is a folder, not a file", file.string());
    if (fs::exists(status)) return {};
    if (!has_frame_pattern(file))
        return fmt::format("there is no file {} (relative paths start from {})", file.string(), from);
    if (!pattern)
        return fmt::format("there is no file {} (frame patterns are for the G-buffer and its camera)", file.string());
    const fs::path folder = file.parent_path();
    if (folder.empty() || fs::is_directory(folder, error)) return {};
    return fmt::format("there is no folder {}", folder.string());
}

std::string read_text(const fs::path& file) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (fs::is_directory(status)) throw Error(fmt::format("{}: is a folder; a scene file was expected", file.string()));
    if (!fs::exists(status)) throw Error(fmt::format("{}: there is no such file", file.string()));
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(fmt::format("{}: cannot be opened; check its permissions", file.string()));
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (stream.bad()) throw Error(fmt::format("{}: cannot be read", file.string()));
    return text;
}

}  // namespace wrinkle::scene
