#include "io/image_open.h"

#include <fmt/format.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string_view>

#include "io/reason.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// Whether a PNG ends before its last chunk. It is checked here since libpng would print its own message to stderr.
bool is_cut_png(const std::filesystem::path& file) {
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
    std::ifstream in(file, std::ios::binary);
    std::array<char, 8> word{};  // first the signature, then the length and type of each chunk
    in.read(word.data(), word.size());
    if (!in || std::string_view(word.data(), word.size()) != signature) return false;
    while (in.read(word.data(), word.size())) {
        if (std::string_view(word.data() + 4, 4) == "IEND") return false;
        std::uint32_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(word[i]);
        in.seekg(std::int64_t{length} + 4, std::ios::cur);  // 4: the chunk's checksum
    }
    return true;
}

}  // namespace

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
    if (std::filesystem::is_regular_file(status) && is_cut_png(file))
        throw Error(fmt::format("{}: the PNG is truncated; was it still being written?", file.string()));
    OIIO::geterror();  // forgets messages of earlier calls
    auto input = OIIO::ImageInput::open(file.string(), &options);
    if (!input) throw Error(fmt::format("{}: not an image, or damaged{}", file.string(), reason(OIIO::geterror())));
    return input;
}

}  // namespace wrinkle::io
