#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr mode_t default_mode = 0666;  // the system takes the umask off

std::filesystem::path folder_of(const std::filesystem::path& file) {
    return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// A name that no other process and no other file of this one has, so that two writers of one target do not collide.
std::filesystem::path partial_name(const std::filesystem::path& target) {
    static std::atomic<int> count{0};
    return folder_of(target) / fmt::format(".{}.{}-{}.partial", target.filename().string(), ::getpid(), ++count);
}

}  // namespace

int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return written < 0 ? errno : EIO;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

AtomicFile::AtomicFile(std::filesystem::path target, Temporary temporary) : target_(std::move(target)) {
    std::error_code code;
    // A symbolic link stays: the file that it points at is replaced.
    if (std::filesystem::is_symlink(target_, code)) {
        if (auto resolved = std::filesystem::canonical(target_, code); !code) target_ = std::move(resolved);
    }
    const auto status = std::filesystem::status(target_, code);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw Error(fmt::format("cannot write {}: it is a {}", target_.string(),
                                std::filesystem::is_directory(status) ? "folder" : "device, not a file"));
    }
    const auto folder = folder_of(target_);
    if (!std::filesystem::is_directory(folder, code)) {
        throw Error(fmt::format("cannot write {}: there is no folder {}", target_.string(), folder.string()));
    }
    partial_ = partial_name(target_);
    if (temporary == Temporary::named || !open_unnamed(folder)) open_named();
    copy_permissions();
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (named_) ::unlink(partial_.c_str());
}

bool AtomicFile::open_unnamed(const std::filesystem::path& folder) {
    descriptor_ = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, default_mode);
    if (descriptor_ < 0) return false;
    if (::access(fmt::format("/proc/self/fd/{}", descriptor_).c_str(), F_OK) == 0) return true;
    ::close(std::exchange(descriptor_, -1));  // without /proc the file could never be given a name
    return false;
}

void AtomicFile::open_named() {
    descriptor_ = ::open(partial_.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, default_mode);
    if (descriptor_ < 0) {
        throw Error(fmt::format("cannot write {}: the folder {} is not writable: {}", target_.string(),
                                folder_of(target_).string(), std::strerror(errno)));
    }
    named_ = true;
}

void AtomicFile::copy_permissions() const {
    struct stat old {};
    // The new file gets the old one's permissions if the system allows it; if not, the default ones will do.
    if (::stat(target_.c_str(), &old) == 0 && ::fchmod(descriptor_, old.st_mode & 0777) != 0) errno = 0;
}

std::string AtomicFile::failure(const std::string& reason) const {
    std::error_code code;
    return fmt::format(
        "cannot write {}: {}; {}", target_.string(), reason,
        std::filesystem::exists(target_, code) ? "the old file is unchanged" : "no file was left behind");
}

void AtomicFile::link_into_place() {
    const auto source = fmt::format("/proc/self/fd/{}", descriptor_);
    if (::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, target_.c_str(), AT_SYMLINK_FOLLOW) == 0) return;
    // A link cannot replace a file that exists. So the new file is linked beside it, then renamed, which replaces the
    // old one in a single step.
    if (errno != EEXIST || ::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, partial_.c_str(), AT_SYMLINK_FOLLOW) != 0) {
        throw Error(failure(std::strerror(errno)));
    }
    named_ = true;
}

void AtomicFile::write(std::string_view bytes) const {
    if (const int failed = write_all(descriptor_, bytes); failed != 0) throw Error(failure(std::strerror(failed)));
}

void AtomicFile::sync() const {
    if (::fsync(descriptor_) != 0) throw Error(failure(std::strerror(errno)));
}

void AtomicFile::commit() {
    sync();
    if (!named_) link_into_place();
    if (named_) {
        if (::rename(partial_.c_str(), target_.c_str()) != 0) throw Error(failure(std::strerror(errno)));
        named_ = false;
    }
    // Network file systems may report an error of an earlier write only now.
    if (::close(std::exchange(descriptor_, -1)) != 0) {
        throw Error(fmt::format("cannot write {}: {}", target_.string(), std::strerror(errno)));
    }
}

}  // namespace wrinkle
