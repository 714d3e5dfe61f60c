#include "base/limits.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <climits>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <optional>
#include <system_error>

#include "base/claim.h"
#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

namespace fs = std::filesystem;

constexpr double kGigabyte = 1e9;

Limits& current() {
    static Limits held;
    return held;
}

std::optional<double> first_number_of(const fs::path& file) {
    std::ifstream in(file);
    double bytes = 0;  // "max" is none
    return in >> bytes ? std::optional(bytes) : std::nullopt;
}

/// The least limit of this process's cgroup and those around it. Nothing without cgroups, or without a limit.
std::optional<double> cgroup_limit() {
    const fs::path root = "/sys/fs/cgroup";
    std::optional<double> least;
    const auto take = [&](const fs::path& file) {
        if (const auto found = first_number_of(file); found && (!least || *found < *least)) least = found;
    };
    std::ifstream groups("/proc/self/cgroup");
    for (std::string line; std::getline(groups, line);) {  // "0::/user.slice", or "7:memory:/user.slice" of version 1
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool is_first_version = controllers.find("memory") != std::string::npos;
        if (!controllers.empty() && !is_first_version) continue;
        const fs::path base = is_first_version ? root / "memory" : root;
        const char* const file = is_first_version ? "memory.limit_in_bytes" : "memory.max";
        for (fs::path group = line.substr(second + 1);; group = group.parent_path()) {
            take(base / group.relative_path() / file);
            if (!group.has_relative_path()) break;
        }
    }
    return least;
}

/// What this process has taken: of the machine's memory, and of addresses, which ulimit -v counts.
struct Taken {
    double memory = 0, addresses = 0;
};

Taken taken_memory() {
    std::ifstream in("/proc/self/statm");
    double addresses = 0, memory = 0;  // in pages; nothing where there is no /proc
    in >> addresses >> memory;
    const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
    return {memory * page, addresses * page};
}

bool is_within(const fs::path& folder, const fs::path& file) {
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

/// The value of WRINKLE_MEMORY in bytes. Throws Error for what is no number of gigabytes.
std::optional<double> memory_of_environment() {
    const char* const text = std::getenv("WRINKLE_MEMORY");
    if (text == nullptr || *text == '\0') return {};
    char* end = nullptr;
    const double gigabytes = std::strtod(text, &end);
    if (*end != '\0' || !(gigabytes > 0))
        throw Error(fmt::format("WRINKLE_MEMORY is {}; a number of gigabytes was expected", quote(text)));
    return gigabytes * kGigabyte;
}

std::optional<double> address_limit() {
    rlimit own{};
    if (::getrlimit(RLIMIT_AS, &own) != 0 || own.rlim_cur == RLIM_INFINITY) return {};
    return static_cast<double>(own.rlim_cur);
}

}  // namespace

void set_limits(const Limits& limits) {
    Limits checked = limits;
    std::error_code failed;
    if (!limits.sandbox.empty()) {
        checked.sandbox = fs::canonical(limits.sandbox, failed);
        if (failed || !fs::is_directory(checked.sandbox, failed))
            throw Error(fmt::format("the sandbox {}: there is no such folder", limits.sandbox.string()));
    }
    current() = checked;
}

const Limits& limits() { return current(); }

MemoryLimit memory_limit() {
    const Taken taken = taken_memory();
    MemoryLimit least{std::numeric_limits<double>::infinity(), 0, ""};
    const auto take = [&](std::optional<double> bytes, double counted, const char* whose) {
        if (bytes && *bytes > 0 && *bytes - counted < least.bytes - least.taken) least = {*bytes, counted, whose};
    };
    take(static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)), taken.memory,
         "the machine");
    take(cgroup_limit(), taken.memory, "the cgroup");
    take(address_limit(), taken.addresses, "the process (ulimit -v)");
    take(memory_of_environment(), taken.memory, "WRINKLE_MEMORY");
    take(static_cast<double>(limits().memory), taken.memory, "--memory");
    return least;
}

double address_room() {
    const std::optional<double> limit = address_limit();
    return limit ? *limit - taken_memory().addresses : std::numeric_limits<double>::infinity();
}

bool is_memory_set() { return limits().memory != 0 || memory_of_environment().has_value(); }

void check_memory(const std::string& name, double bytes, const std::string& what) {
    if (bytes <= kHarmless) return;
    const MemoryLimit limit = memory_limit();
    if (limit.taken + bytes <= limit.bytes) return;
    throw Error(fmt::format("{}: {} would take {} of memory beside the {} in use; the limit of {} is {}", name, what,
                            bytes_text(bytes), bytes_text(limit.taken), limit.whose, bytes_text(limit.bytes)));
}

bool may_be_allowed(const fs::path& file) {
    std::error_code failed;
    return limits().sandbox.empty() || is_within(limits().sandbox, fs::weakly_canonical(fs::absolute(file), failed));
}

bool is_allowed(int descriptor) {
    const fs::path& sandbox = limits().sandbox;
    if (sandbox.empty()) return true;
    std::array<char, PATH_MAX> real{};
    const ssize_t size = ::readlink(fmt::format("/proc/self/fd/{}", descriptor).c_str(), real.data(), real.size());
    if (size <= 0 || static_cast<std::size_t>(size) == real.size()) return false;
    return is_within(sandbox, std::string(real.data(), static_cast<std::size_t>(size)));
}

}  // namespace wrinkle
