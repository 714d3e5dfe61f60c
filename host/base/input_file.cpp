#include "base/input_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/limits.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 16;

const char* kind_of(mode_t mode) {
    if (S_ISDIR(mode)) return "folder";
    if (S_ISFIFO(mode)) return "pipe";
    if (S_ISSOCK(mode)) return "socket";
    return "device";
}

[[noreturn]] void fail(const std::string& name, int reason) {
    if (reason == ENOENT || reason == ENOTDIR) throw Error(fmt::format("{}: there is no such file", name));
    throw Error(fmt::format("{}: cannot be read: {}", name, std::strerror(reason)));
}

void check_regular(const struct stat& status, const std::string& name, std::string_view expected) {
    if (S_ISREG(status.st_mode)) return;
    throw Error(
        fmt::format("{}: cannot be read: it is a {}; {} was expected", name, kind_of(status.st_mode), expected));
}

}  // namespace

InputFile::InputFile(std::filesystem::path path, std::string_view expected) : path_(std::move(path)) {
    struct stat status {};
    // Asked before, since opening alone makes some devices act, and again of what has been opened.
    if (::stat(path_.c_str(), &status) != 0) fail(name(), errno);
    check_regular(status, name(), expected);
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (descriptor_ < 0) fail(name(), errno);
    try {
        if (::fstat(descriptor_, &status) != 0) fail(name(), errno);
        check_regular(status, name(), expected);
        if (!is_allowed(descriptor_))
            throw Error(fmt::format("{}: lies outside of the folder {}, and nothing else may be read", name(),
                                    limits().sandbox.string()));
    } catch (...) {
        ::close(descriptor_);
        throw;
    }
    size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::InputFile(int descriptor, std::filesystem::path path) : path_(std::move(path)), descriptor_(descriptor) {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail(name(), errno);
    size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() { ::close(descriptor_); }

std::size_t InputFile::read_at(std::uint64_t offset, void* to, std::size_t size) const {
    std::size_t filled = 0;
    while (filled < size) {
        const ssize_t got =
            ::pread(descriptor_, static_cast<char*>(to) + filled, size - filled, static_cast<off_t>(offset + filled));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail(name(), errno);
        if (got == 0) break;
        filled += static_cast<std::size_t>(got);
    }
    return filled;
}

void InputFile::read_ahead() const {
    constexpr off_t most = off_t{512} << 20;
    ::posix_fadvise(descriptor_, 0, most, POSIX_FADV_WILLNEED);
}

std::string InputFile::read_all() const {
    // The size is a hint only: files grow, and those of /proc have none.
    check_memory(name(), static_cast<double>(size_), "all of it");
    std::string bytes(static_cast<std::size_t>(size_) + 1, '\0');
    for (std::size_t filled = 0;;) {
        const std::size_t got = read_at(filled, bytes.data() + filled, bytes.size() - filled);
        filled += got;
        if (filled < bytes.size()) {
            bytes.resize(filled);
            return bytes;
        }
        bytes.resize(bytes.size() + std::max(bytes.size(), kBlock));
    }
}

}  // namespace wrinkle
