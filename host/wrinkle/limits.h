#pragma once

#include <cstdint>
#include <filesystem>

namespace [[gnu::visibility("default")]] wrinkle {

/// What files that somebody else made may do to this process. SECURITY.md says what is promised with and without them.
struct Limits {
    /// Bytes that the process may take: what it would need more for is refused before; 0: what WRINKLE_MEMORY (in GB),
    /// the process's own limit, its cgroup's and the machine allow, the least of them.
    std::uint64_t memory = 0;
    /// Files outside of this folder are not read, whatever links lead to them, and a layer of kind "kernel", which is
    /// native code, is refused. Empty: files may be anywhere.
    std::filesystem::path sandbox;
    /// The wrinkle program, which then reads OpenVDB files in a process of its own: damaged ones may crash the library
    /// that reads them, or keep it busy for ever. Empty: they are read in this process.
    std::filesystem::path volume_reader;
};

/// Sets the limits of the process. Throws Error when the sandbox is no folder.
///
/// Threads: to be called before other threads call the library.
///
///     wrinkle::set_limits({.memory = std::uint64_t{8} << 30, .sandbox = {}, .volume_reader = {}});
void set_limits(const Limits& limits);

}  // namespace wrinkle
