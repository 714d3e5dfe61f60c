#pragma once

#include <filesystem>

namespace wrinkle {

/// As long as this lives, whoever else asks for the lock of the same folder waits: for files that are read, changed and
/// replaced. The folder itself is locked, so that nothing is left behind. Where there are no locks (some network file
/// systems), nobody waits.
class FolderLock {
public:
    explicit FolderLock(const std::filesystem::path& folder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

private:
    int descriptor_;
};

}  // namespace wrinkle
