#include "scene/files.h"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>

#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace fs = std::filesystem;

bool is_frame_pattern(std::string_view name) {
    if (name.find('#') != std::string_view::npos) return true;
    for (std::size_t at = name.find('%'); at != std::string_view::npos; at = name.find('%', at + 1)) {
        std::size_t end = at + 1;
        while (end < name.size() && std::isdigit(static_cast<unsigned char>(name[end]))) ++end;
        if (end < name.size() && name[end] == 'd') return true;
    }
    return false;
}

std::string why_not_readable(const fs::path& file, bool pattern) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (fs::is_directory(status)) return fmt::format("{} is a folder, not a file", file.string());
    if (fs::exists(status)) return {};
    if (pattern && is_frame_pattern(file.string())) {
        fs::path folder = file.parent_path();
        while (is_frame_pattern(folder.string())) folder = folder.parent_path();
        if (folder.empty() || fs::is_directory(folder, error)) return {};
        return fmt::format("there is no folder {}", folder.string());
    }
    if (is_frame_pattern(file.string()))
        return fmt::format("there is no file {} (frame patterns are for the G-buffer and its camera)", file.string());
    return fmt::format("there is no file {} (relative paths start from the scene's folder)", file.string());
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
