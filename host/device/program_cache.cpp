#include "device/program_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

#include "base/atomic_file.h"
#include "base/input_file.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace fs = std::filesystem;

namespace {

constexpr char kMagic[] = "wrinkle program 2\n";
constexpr char kExtension[] = ".program";
constexpr std::chrono::hours kAbandoned(1);  // a program that is still without its name was of a killed run

/// FNV-1a, 64 bits, with two offsets for 128: names files, protects nothing.
std::string hash_name(const std::string& text) {
    std::uint64_t a = 0xcbf29ce484222325u, b = 0x84222325cbf29ce4u;
    for (const unsigned char c : text) {
        a = (a ^ c) * 0x100000001b3u;
        b = (b ^ (c + 0x9e)) * 0x100000001b3u;
    }
    return fmt::format("{:016x}{:016x}", a, b);
}

std::string with_length(const std::string& key) { return fmt::format("{:016x}{}", key.size(), key); }

/// A program that was being written, by this version (".HASH.program.NAME.partial") or by those before it
/// ("HASH.program.NAME"). The folder may be somebody's own, with other unfinished files in it.
bool is_unfinished(const fs::path& file) {
    constexpr std::size_t kHash = 32;
    std::string name = file.filename();
    if (name.starts_with('.')) name.erase(0, 1);
    const std::size_t hash = std::min(name.find_first_not_of("0123456789abcdef"), name.size());
    return hash == kHash && name.substr(kHash).starts_with(std::string(kExtension) + ".");
}

/// Deletes the longest unused programs of a folder until the rest is within `limit` bytes, and what killed runs left.
/// Other processes may do the same: a file that is gone already is none.
void prune(const fs::path& folder, std::uintmax_t limit) {
    struct Entry {
        fs::path file;
        fs::file_time_type used;
        std::uintmax_t size;
    };
    std::vector<Entry> entries;
    std::error_code ignored;
    std::error_code failed;
    for (fs::directory_iterator at(folder, failed), end; !failed && at != end; at.increment(failed)) {
        std::error_code gone;
        const Entry found{at->path(), at->last_write_time(gone), at->file_size(gone)};
        if (gone) continue;
        if (found.file.extension() == kExtension) entries.push_back(found);
        if (is_unfinished(found.file) && fs::file_time_type::clock::now() - found.used > kAbandoned)
            fs::remove(found.file, gone);
    }
    std::ranges::sort(entries, std::greater{}, &Entry::used);
    std::uintmax_t kept = 0;
    for (const Entry& entry : entries) {
        kept += entry.size;
        if (kept > limit) fs::remove(entry.file, ignored);
    }
}

}  // namespace

fs::path cache_folder() {
    if (const char* folder = std::getenv("WRINKLE_CACHE_DIR"); folder != nullptr && *folder != '\0') return folder;
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache != '\0')
        return fs::path(cache) / "wrinkle";
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return fs::path(home) / ".cache/wrinkle";
    return {};
}

fs::path cache_file(const std::string& key) {
    const fs::path folder = cache_folder();
    return folder.empty() ? fs::path() : folder / (hash_name(key) + kExtension);
}

// A file is: magic, hash of the rest, length of the key as 16 hex digits, key, binary.
std::vector<unsigned char> read_program(const fs::path& file, const std::string& key) {
    std::string content;
    try {
        content = InputFile(file, "a built program").read_all();
    } catch (const Error&) { return {}; }  // not there, or something else of that name: it is built anew
    const std::size_t header = sizeof kMagic - 1 + 32;
    if (content.size() <= header || !content.starts_with(kMagic)) return {};
    const std::string rest = content.substr(header), expected = with_length(key);
    if (hash_name(rest) != content.substr(sizeof kMagic - 1, 32) || !rest.starts_with(expected)) return {};
    std::error_code ignored;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return {rest.begin() + static_cast<std::ptrdiff_t>(expected.size()), rest.end()};
}

void write_program(const fs::path& file, const std::string& key, const std::vector<unsigned char>& binary,
                   std::uintmax_t limit) {
    std::string rest = with_length(key);
    rest.append(binary.begin(), binary.end());
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    try {
        AtomicFile out(file);
        out.write(kMagic + hash_name(rest) + rest);
        out.commit();
    } catch (const Error&) { return; }  // a cache that cannot be written is none
    prune(file.parent_path(), limit);
}

}  // namespace wrinkle
