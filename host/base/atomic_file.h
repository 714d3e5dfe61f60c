#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/temporary_name.h"

namespace wrinkle {

/// Writes all of `bytes`. Returns 0, or the errno of the write that failed.
int write_all(int descriptor, std::string_view bytes);

/// A file that appears under its name only when it is complete.
///
/// It is written to an unnamed file (O_TMPFILE) in the target's folder, so that not even `kill -9` leaves anything
/// behind; file systems without such files (many network ones) get ".NAME.RANDOM.partial", which goes unless commit()
/// succeeds: with this object, with the signal that ends the program (base/temporary_name.h), or when the same file is
/// written the next time.
class AtomicFile {
public:
    enum class Temporary { unnamed_if_possible, named };

    /// Throws Error when the folder is missing or not writable, or the target is not a regular file.
    explicit AtomicFile(std::filesystem::path target, Temporary temporary = Temporary::unnamed_if_possible);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    int descriptor() const { return descriptor_; }

    /// Appends. Throws Error when the disk is full.
    void write(std::string_view bytes) const;

    /// Waits until all that was written is on disk; the file still has no name. Throws Error.
    void sync() const;

    /// Waits until the file is on disk, then puts it in place of the old one. When it throws Error, the old file is
    /// still there.
    void commit();

    /// "cannot write FILE: REASON; the old file is unchanged".
    std::string failure(const std::string& reason) const;

private:
    bool open_unnamed(const std::filesystem::path& folder);
    void open_named();
    void copy_permissions() const;
    void link_into_place();
    void sync_folder() const;

    std::filesystem::path target_, partial_;
    std::optional<DoomedFile> doomed_;
    int descriptor_ = -1;
    bool named_ = false;  ///< partial_ exists and is ours to remove
};

}  // namespace wrinkle
