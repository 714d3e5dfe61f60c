#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "wrinkle/limits.h"

/// The limits of the process, for whoever has to keep them.
namespace wrinkle {

/// As set_limits() set them.
const Limits& limits();

/// The limit of memory that leaves least room, and whose it is.
struct MemoryLimit {
    double bytes = 0;
    double taken = 0;   ///< of them, by this process so far
    std::string whose;  ///< "--memory", "the cgroup"
};
MemoryLimit memory_limit();

/// How many bytes of addresses the process may still take (ulimit -v); infinite without that limit.
double address_room();

/// Whether somebody has said how much memory this process may take, by --memory or WRINKLE_MEMORY.
bool is_memory_set();

/// Throws Error, beginning with `name`, when `what`, which takes `bytes`, is more than memory_limit() leaves. Asked
/// before everything large, it keeps the whole process within its limit.
void check_memory(const std::string& name, double bytes, const std::string& what);

/// Whether a name leads into the sandbox, or there is no sandbox. The file behind a name may change, so is_allowed()
/// decides once it is open.
bool may_be_allowed(const std::filesystem::path& file);

/// Whether a file that is open lies within the sandbox, or there is none.
bool is_allowed(int descriptor);

}  // namespace wrinkle
