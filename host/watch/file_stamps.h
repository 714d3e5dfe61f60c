#pragma once

#include <sys/types.h>
#include <filesystem>
#include <map>
#include <span>

namespace wrinkle {

/// Tells whether files changed since it looked at them last, by their size and time of change.
class FileStamps {
public:
    /// Has a look at files that were not looked at yet.
    void know(std::span<const std::filesystem::path> files);
    /// Whether any of the files is not as it was when it was last looked at; the first time none is.
    bool changed(std::span<const std::filesystem::path> files);

private:
    struct Stamp {
        long long size = -1, seconds = 0, nanoseconds = 0;  ///< -1: no such file
        ino_t inode = 0;
        bool operator==(const Stamp&) const = default;
    };
    static Stamp stamp_of(const std::filesystem::path& file);

    std::map<std::filesystem::path, Stamp> stamps_;
};

}  // namespace wrinkle
