#include "device/program_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

namespace wrinkle {

namespace fs = std::filesystem;

namespace {

constexpr char kMagic[] = "wrinkle program 1\n";
constexpr char kExtension[] = ".program";

/// FNV-1a, 64 bits, with two offsets for 128: names files, protects nothing.
std::string hash_name(const std::string& text) {
    std::uint64_t a = 0xcbf29ce484222325u, b = 0x84222325cbf29ce4u;
    for (const unsigned char c : text) {
        a = (a ^ c) * 0x100000001b3u;
        b = (b ^ (c + 0x9e)) * 0x100000001b3u;
    }
    return fmt::format("{:016x}{:016x}", a, b);
}

/// Deletes the longest unused programs of a folder until the rest is within `limit` bytes. Other processes may do the
/// same: a file that is gone already is none.
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
        if (!gone && found.file.extension() == kExtension) entries.push_back(found);
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

// A file is: magic, hash of the binary, binary.
std::vector<unsigned char> read_program(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) return {};
    const std::string content{std::istreambuf_iterator<char>(in), {}};
    const std::size_t header = sizeof kMagic - 1 + 32;
    if (content.size() <= header || !content.starts_with(kMagic)) return {};
    const std::string binary = content.substr(header);
    if (hash_name(binary) != content.substr(sizeof kMagic - 1, 32)) return {};
    std::error_code ignored;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
    return {binary.begin(), binary.end()};
}

void write_program(const fs::path& file, const std::vector<unsigned char>& bytes, std::uintmax_t limit) {
    const std::string binary(bytes.begin(), bytes.end());
    std::error_code ignored;
    fs::create_directories(file.parent_path(), ignored);
    fs::path beside = file;
    beside += fmt::format(".{}", ::getpid());
    {
        std::ofstream out(beside, std::ios::binary);
        out << kMagic << hash_name(binary) << binary;
        if (!out.flush()) {
            fs::remove(beside, ignored);
            return;
        }
    }
    fs::rename(beside, file, ignored);
    prune(file.parent_path(), limit);
}

}  // namespace wrinkle
