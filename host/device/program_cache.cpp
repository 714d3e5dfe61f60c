#include "device/program_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>

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

/// Where a program is written before it has its name: of this process and call alone.
fs::path unfinished_name(const fs::path& file) {
    static std::atomic<int> count{0};
    fs::path beside = file;
    return beside += fmt::format(".{}-{}", ::getpid(), ++count);
}

bool is_unfinished(const fs::path& file) { return file.stem().extension() == kExtension; }

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
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
        std::error_code gone;
        const Entry found{entry.path(), entry.last_write_time(gone), entry.file_size(gone)};
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
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    const std::string content{std::istreambuf_iterator<char>(in), {}};
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
    const fs::path beside = unfinished_name(file);
    {
        std::ofstream out(beside, std::ios::binary);
        out << kMagic << hash_name(rest) << rest;
        if (!out.flush()) {
            fs::remove(beside, ignored);
            return;
        }
    }
    fs::rename(beside, file, ignored);
    prune(file.parent_path(), limit);
}

}  // namespace wrinkle
