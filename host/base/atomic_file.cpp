#include "base/atomic_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
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

/// Calls `make` with new names until it succeeds or fails for another reason than that the name is taken.
template <class Make>
bool with_new_name(const std::filesystem::path& target, std::filesystem::path& name, const Make& make) {
    constexpr int kTries = 100;
    for (int i = 0; i < kTries; ++i) {
        name = temporary_name(target);
        if (make(name)) return true;
        if (errno != EEXIST) return false;
    }
    return false;
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
    hold_temporary(descriptor_);  // for the moment in which it has a temporary name after all: link_into_place()
    if (::access(fmt::format("/proc/self/fd/{}", descriptor_).c_str(), F_OK) == 0) return true;
    ::close(std::exchange(descriptor_, -1));  // without /proc the file could never be given a name
    return false;
}

void AtomicFile::open_named() {
    remove_abandoned(target_);
    const bool made = with_new_name(target_, partial_, [&](const std::filesystem::path& name) {
        DoomedFile doomed(name);
        descriptor_ = ::open(name.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, default_mode);
        if (descriptor_ < 0) return false;
        doomed_.emplace(std::move(doomed));
        if (hold_temporary(descriptor_)) return true;
        ::close(std::exchange(descriptor_, -1));  // another writer took it for one that nobody writes any more
        errno = EEXIST;
        return false;
    });
    if (!made) {
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
    const auto link = [&](const std::filesystem::path& name) {
        DoomedFile doomed(name);
        if (::linkat(AT_FDCWD, source.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) return false;
        doomed_.emplace(std::move(doomed));
        return true;
    };
    if (errno != EEXIST || !with_new_name(target_, partial_, link)) { throw Error(failure(std::strerror(errno))); }
    named_ = true;
}

void AtomicFile::write(std::string_view bytes) const {
    if (const int failed = write_all(descriptor_, bytes); failed != 0) throw Error(failure(std::strerror(failed)));
}

void AtomicFile::sync() const {
    if (::fsync(descriptor_) != 0) throw Error(failure(std::strerror(errno)));
}

/// Without it, the new name might be lost with the power. Some file systems cannot do so, and need not.
void AtomicFile::sync_folder() const {
    const int folder = ::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    ::fsync(folder);
    ::close(folder);
}

void AtomicFile::commit() {
    sync();
    if (!named_) link_into_place();
    if (named_) {
        if (::rename(partial_.c_str(), target_.c_str()) != 0) throw Error(failure(std::strerror(errno)));
        named_ = false;
        doomed_.reset();
    }
    sync_folder();
    // Network file systems may report an error of an earlier write only now.
    if (::close(std::exchange(descriptor_, -1)) != 0) {
        throw Error(fmt::format("cannot write {}: {}", target_.string(), std::strerror(errno)));
    }
}

}  // namespace wrinkle
