#include "base/text_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/claim.h"
#include "base/input_file.h"
#include "base/limits.h"
#include "base/only_errors.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

[[noreturn]] void fail_too_long(const std::string& name, double most) {
    throw Error(fmt::format("{}: it is longer than {}, which no such file needs", name, bytes_text(most)));
}

}  // namespace

std::string read_text(const std::filesystem::path& file, std::string_view expected, double most) {
    const InputFile in(file, expected);
    if (static_cast<double>(in.size()) > most) fail_too_long(in.name(), most);
    return only_errors(in.name().c_str(), [&] { return in.read_all(); });
}

std::string read_standard_input(double most) {
    const std::string name = "standard input";
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    std::string text(kBlock, '\0');
    for (std::size_t filled = 0;;) {
        if (filled == text.size()) {
            if (static_cast<double>(filled) > most) fail_too_long(name, most);
            check_memory(name, 2.0 * static_cast<double>(filled), "what comes through it");
            text.resize(2 * text.size());
        }
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
