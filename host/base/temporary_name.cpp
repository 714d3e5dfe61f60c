#include "base/temporary_name.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstring>
#include <random>
#include <utility>

namespace wrinkle {
namespace {

namespace fs = std::filesystem;

constexpr char kExtension[] = ".partial";

/// What a signal handler can read: fixed memory, and a flag that is set when the path is whole.
struct Slot {
    std::atomic<bool> taken = false, whole = false;
    std::array<char, PATH_MAX> path{};
};
constexpr std::size_t kSlots =
    64;  // files that a process writes at once; if there are more, the others stay after a signal
std::array<Slot, kSlots> slots;

void remove_doomed() {
    for (Slot& slot : slots)
        if (slot.whole) ::unlink(slot.path.data());
}

}  // namespace

fs::path temporary_name(const fs::path& target) {
    static thread_local std::mt19937_64 random{std::uint64_t{std::random_device{}()} << 32 ^ std::random_device{}()};
    fs::path name = target;
    return name.replace_filename(
        fmt::format(".{}.{:012x}{}", target.filename().string(), random() & 0xffff'ffff'ffff, kExtension));
}

void remove_abandoned(const fs::path& target) {
    const std::string begin = fmt::format(".{}.", target.filename().string());
    const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        const std::string name = at->path().filename().string();
        if (!name.starts_with(begin) || !name.ends_with(kExtension)) continue;
        const int descriptor = ::open(at->path().c_str(), O_RDWR | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC);
        if (descriptor < 0) continue;
        if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(at->path().c_str());
        ::close(descriptor);
    }
}

bool hold_temporary(int descriptor) {
    struct stat status {};
    // Without locks (some network file systems) nobody removes anything either.
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) return errno != EWOULDBLOCK;
    return ::fstat(descriptor, &status) == 0 && status.st_nlink > 0;
}

DoomedFile::DoomedFile(const fs::path& file) {
    const std::string path = fs::absolute(file).string();
    if (path.size() >= PATH_MAX) return;
    for (std::size_t i = 0; i < kSlots; ++i) {
        if (slots[i].taken.exchange(true)) continue;
        std::memcpy(slots[i].path.data(), path.c_str(), path.size() + 1);
        slots[i].whole = true;
        slot_ = static_cast<int>(i);
        return;
    }
}

DoomedFile::~DoomedFile() {
    if (slot_ < 0) return;
    Slot& slot = slots[static_cast<std::size_t>(slot_)];
    slot.whole = false;
    slot.taken = false;
}

DoomedFile::DoomedFile(DoomedFile&& other) noexcept : slot_(std::exchange(other.slot_, -1)) {}

DoomedFile& DoomedFile::operator=(DoomedFile&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
}

void remove_temporaries_on_signals() {
    struct sigaction remove {};
    remove.sa_handler = [](int signal) {
        remove_doomed();
        ::raise(signal);  // the default action, which the handler was reset to
    };
    remove.sa_flags = static_cast<int>(SA_RESETHAND) | SA_NODEFER;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        struct sigaction before {};
        if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
            ::sigaction(signal, &remove, nullptr);
    }
}

}  // namespace wrinkle
