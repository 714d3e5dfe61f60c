#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace wrinkle {

/// A file to read, opened once. Whatever its name comes to mean afterwards, everything is read from the file that was
/// opened: a writer that replaces it by rename cannot make two readers see two files.
///
/// Only regular files are opened. A pipe without a writer would be waited for for ever, and devices never end.
///
/// Threads: all members may be called at once.
class InputFile {
public:
    /// `expected` names what it should be, for messages. Throws Error, beginning with the file's name, when there is no
    /// such file, it is something else (a folder, a pipe, a device), or may not be read.
    explicit InputFile(std::filesystem::path path, std::string_view expected = "a file");
    /// What somebody else has opened, and checked. `path` is for messages.
    InputFile(int descriptor, std::filesystem::path path);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::string name() const { return path_.string(); }
    std::uint64_t size() const { return size_; }  ///< when it was opened
    int descriptor() const { return descriptor_; }

    /// Reads up to `size` bytes from `offset` on. Fewer than that means that the file ends there. Throws Error when the
    /// disk fails.
    std::size_t read_at(std::uint64_t offset, void* to, std::size_t size) const;

    /// Asks the system to fetch it from its disk or server, and does not wait for that. Of a very large file, of which
    /// few parts may be wanted, its first half gigabyte.
    void read_ahead() const;

    /// All of it. Throws Error.
    std::string read_all() const;

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace wrinkle
