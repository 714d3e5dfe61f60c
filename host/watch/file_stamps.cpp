#include "watch/file_stamps.h"

#include <sys/stat.h>

namespace wrinkle {

FileStamps::Stamp FileStamps::stamp_of(const std::filesystem::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return {};
    return {status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_ino};
}

void FileStamps::know(std::span<const std::filesystem::path> files) {
    for (const std::filesystem::path& file : files) stamps_.try_emplace(file, stamp_of(file));
}

bool FileStamps::changed(std::span<const std::filesystem::path> files) {
    bool any = false;
    for (const std::filesystem::path& file : files) {
        const Stamp now = stamp_of(file);
        const auto [known, is_new] = stamps_.try_emplace(file, now);
        any |= !is_new && known->second != now;
        known->second = now;
    }
    return any;
}

}  // namespace wrinkle
