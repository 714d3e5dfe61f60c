#include "base/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "wrinkle/error.h"

namespace wrinkle {
namespace {

/// Closes what it holds.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { ::close(number_); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

private:
    int number_;
};

[[noreturn]] void fail(const std::string& name, int reason) {
    throw Error(fmt::format("{}: cannot be read: {}", name, std::strerror(reason)));
}

/// Sizes are hints only: pipes have none, and files may grow.
std::string read_all(int descriptor, const std::string& name) {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    struct stat about {};
    const bool sized = ::fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode);
    std::string text(sized ? static_cast<std::size_t>(about.st_size) + 1 : kBlock, '\0');
    for (std::size_t filled = 0;;) {
        if (filled == text.size()) text.resize(2 * text.size());
        const ssize_t size = ::read(descriptor, text.data() + filled, text.size() - filled);
        if (size < 0 && errno == EINTR) continue;
        if (size < 0) fail(name, errno);
        if (size == 0) {
            text.resize(filled);
            return text;
        }
        filled += static_cast<std::size_t>(size);
    }
}

}  // namespace

std::string read_text(const std::filesystem::path& file, std::string_view expected) {
    const std::string name = file.string();
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR))
        throw Error(fmt::format("{}: there is no such file", name));
    if (descriptor < 0) fail(name, errno);
    const Descriptor closing(descriptor);
    std::error_code code;
    if (std::filesystem::is_directory(file, code))
        throw Error(fmt::format("{}: cannot be read: it is a folder; {} was expected", name, expected));
    return read_all(descriptor, name);
}

std::string read_standard_input() { return read_all(STDIN_FILENO, "standard input"); }

}  // namespace wrinkle
