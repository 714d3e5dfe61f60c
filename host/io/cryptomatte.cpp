#include "io/cryptomatte.h"

#include <fmt/format.h>
#include <fnmatch.h>
#include <bit>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/names.h"
#include "base/text_file.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

std::uint32_t murmur3_32(std::string_view text) {
    const auto scramble = [](std::uint32_t k) { return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u; };
    std::uint32_t hash = 0;
    std::size_t i = 0;
    for (; i + 4 <= text.size(); i += 4) {
        std::uint32_t block;
        std::memcpy(&block, text.data() + i, 4);
        hash = std::rotl(hash ^ scramble(block), 13) * 5 + 0xe6546b64u;
    }
    std::uint32_t tail = 0;
    for (std::size_t j = text.size(); j > i; --j) tail = tail << 8 | static_cast<unsigned char>(text[j - 1]);
    hash ^= scramble(tail);
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

/// A hash as id channels hold it: with a bit of the exponent flipped where it would be no normal float.
std::uint32_t as_float_bits(std::uint32_t hash) {
    const std::uint32_t exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

std::optional<std::uint32_t> parse_hex(std::string_view digits) {
    if (digits.size() != 8 || digits.find_first_not_of("0123456789abcdefABCDEF") != std::string_view::npos)
        return std::nullopt;
    return static_cast<std::uint32_t>(std::stoul(std::string(digits), nullptr, 16));
}

/// Whether a name leads nowhere but to a file beside the frame. Whoever made the frame chose it, and may not choose
/// which other files are read.
bool is_bare_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
           name.find('\0') == std::string::npos;
}

/// The entries of a manifest that is no JSON: `"NAME":"8 hex digits"`, where the name may hold quotes that nobody
/// escaped, or letters that are no UTF-8.
std::map<std::string, std::uint32_t, std::less<>> entries_of_damaged(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    std::map<std::string, std::uint32_t, std::less<>> ids;
    std::size_t name_begin = text.find('"');
    while (name_begin != std::string_view::npos) {
        ++name_begin;
        std::size_t next = std::string_view::npos;
        for (auto end = text.find('"', name_begin); end != std::string_view::npos; end = text.find('"', end + 1)) {
            const auto colon = text.find_first_not_of(blanks, end + 1);
            if (colon == std::string_view::npos || text[colon] != ':') continue;
            const auto value = text.find_first_not_of(blanks, colon + 1);
            if (value == std::string_view::npos || text[value] != '"' || text.substr(value).size() < 10) continue;
            const auto id = parse_hex(text.substr(value + 1, 8));
            if (!id || text[value + 9] != '"') continue;
            ids.emplace(text.substr(name_begin, end - name_begin), as_float_bits(*id));
            next = value + 10;
            break;
        }
        name_begin = next == std::string_view::npos ? next : text.find('"', next);
    }
    return ids;
}

/// The text of a regular file that a header names, in the folder of the frame and nowhere else; nothing if there is
/// none.
std::optional<std::string> text_beside(const std::filesystem::path& frame, const std::string& name) {
    if (!is_bare_name(name)) return std::nullopt;
    const auto path = frame.parent_path() / name;
    std::error_code code;
    if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(path, code))) return std::nullopt;
    try {
        return read_text(path);
    } catch (const Error&) { return std::nullopt; }
}

/// Which "cryptomatte/KEY/" of the header describes `layer`. Names that differ by a prefix count as the same, and a
/// header with a single cryptomatte describes that one.
std::string find_key(const Metadata& header, const std::string& layer) {
    std::string similar, only;
    int count = 0;
    for (const auto& name : header.names()) {
        if (!name.starts_with("cryptomatte/") || !name.ends_with("/name")) continue;
        const auto key = name.substr(0, name.size() - 4);
        const auto described = header.text(name).value_or("");
        if (described == layer) return key;
        if (layer.ends_with("." + described) || described.ends_with("." + layer)) similar = key;
        only = key, ++count;
    }
    if (!similar.empty()) return similar;
    return count == 1 ? only : "";
}

}  // namespace

std::uint32_t cryptomatte_hash(std::string_view name) { return as_float_bits(murmur3_32(name)); }

bool io::is_name_pattern(const std::string& name) {
    return !name.starts_with('#') && name.find_first_of("*?") != std::string::npos;
}

bool io::matches_name(const std::string& pattern, const std::string& name) {
    return !name.starts_with('#') && ::fnmatch(pattern.c_str(), name.c_str(), FNM_NOESCAPE) == 0;
}

CryptomatteManifest::CryptomatteManifest(const Metadata& header, const std::string& layer,
                                         const std::filesystem::path& file)
    : layer_(layer) {
    const auto key = find_key(header, layer);
    if (key.empty()) return;
    auto text = header.text(key + "manifest").value_or("");
    if (const auto beside = header.text(key + "manif_file"); text.empty() && beside)
        text = text_beside(file, *beside).value_or("");
    if (text.empty()) return;
    const auto json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
    damaged_ = !json.is_object();
    if (damaged_) {
        ids_ = entries_of_damaged(text);
        return;
    }
    for (const auto& [name, value] : json.items()) {
        if (!value.is_string()) continue;
        // Blender writes the hash itself, others what the channels hold.
        if (const auto id = parse_hex(value.get<std::string>())) ids_[name] = as_float_bits(*id);
    }
}

std::vector<std::string> CryptomatteManifest::names() const {
    std::vector<std::string> result;
    for (const auto& [name, id] : ids_) result.push_back(name);
    return result;
}

std::uint32_t CryptomatteManifest::id(std::string_view name) const {
    if (name.starts_with("#")) {
        if (const auto id = parse_hex(name.substr(1))) return *id;
    }
    const auto found = ids_.find(name);
    if (found != ids_.end()) return found->second;
    if (ids_.empty() || damaged_) return cryptomatte_hash(name);
    const auto known = names();
    throw Error(fmt::format("cryptomatte {} has no object \"{}\"; nearest: \"{}\"; objects: {}", layer_, name,
                            nearest_name(name, known), fmt::join(known, ", ")));
}

}  // namespace wrinkle
