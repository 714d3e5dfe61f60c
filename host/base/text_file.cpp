#include "base/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/input_file.h"
#include "wrinkle/error.h"

namespace wrinkle {

std::string read_text(const std::filesystem::path& file, std::string_view expected) {
    return InputFile(file, expected).read_all();
}

std::string read_standard_input() {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    std::string text(kBlock, '\0');
    for (std::size_t filled = 0;;) {
        if (filled == text.size()) text.resize(2 * text.size());
        const ssize_t size = ::read(STDIN_FILENO, text.data() + filled, text.size() - filled);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) throw Error(fmt::format("standard input: cannot be read: {}", std::strerror(errno)));
        if (size == 0) {
            text.resize(filled);
            return text;
        }
        filled += static_cast<std::size_t>(size);
    }
}

}  // namespace wrinkle
