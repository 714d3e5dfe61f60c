#include "io/image_open.h"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstring>

#include "wrinkle/error.h"

namespace wrinkle::io {

std::string reason(std::string text) {
    text = text.substr(0, text.find('\n'));
    // OpenEXR says 'Cannot read image file "F". WHY': the caller has named the file already.
    if (const auto name = text.find("image file \""); name != std::string::npos) {
        const auto why = text.find("\". ", name);
        if (why != std::string::npos) text = text.substr(why + 3);
    }
    while (text.ends_with('.')) text.pop_back();
    constexpr std::size_t longest = 200;
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return text.empty() ? "" : fmt::format(" ({})", text);
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file, const OIIO::ImageSpec& options) {
    std::error_code code;
    const auto status = std::filesystem::status(file, code);
    if (!std::filesystem::exists(status)) {
        const bool missing = status.type() == std::filesystem::file_type::not_found;
        throw Error(fmt::format("{}: {}", file.string(), missing ? "no such file" : code.message()));
    }
    if (std::filesystem::is_directory(status)) throw Error(fmt::format("{}: a folder, not an image", file.string()));
    if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(file, code) == 0) {
        throw Error(fmt::format("{}: the file is empty (0 bytes); was it still being written?", file.string()));
    }
    if (::access(file.c_str(), R_OK) != 0) {
        throw Error(fmt::format("{}: cannot be read: {}", file.string(), std::strerror(errno)));
    }
    OIIO::geterror();  // drop what earlier calls left behind
    auto input = OIIO::ImageInput::open(file.string(), &options);
    if (!input) throw Error(fmt::format("{}: not an image, or damaged{}", file.string(), reason(OIIO::geterror())));
    return input;
}

}  // namespace wrinkle::io
