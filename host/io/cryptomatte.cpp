#include "io/cryptomatte.h"

#include <fmt/format.h>
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

std::uint32_t cryptomatte_hash(std::string_view name) {
    const std::uint32_t hash = murmur3_32(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

CryptomatteManifest::CryptomatteManifest(const Metadata& header, const std::string& layer,
                                         const std::filesystem::path& file)
    : layer_(layer) {
    const auto key = find_key(header, layer);
    if (key.empty()) return;
    auto text = header.text(key + "manifest").value_or("");
    std::string origin = file.string();
    if (const auto beside = header.text(key + "manif_file"); text.empty() && beside && is_bare_name(*beside)) {
        const auto path = file.parent_path() / *beside;
        try {
            text = read_text(path);
        } catch (const Error&) {
            return;  // without a manifest, names are hashed
        }
        origin = path.string();
    }
    if (text.empty()) return;
    const auto json = nlohmann::json::parse(text, nullptr, /*allow_exceptions=*/false);
    if (!json.is_object()) {
        damage_ = fmt::format(
            "{}: the manifest of cryptomatte {} is not a JSON object of names; name objects as \"#\" "
            "and 8 hex digits, or render the frame anew",
            origin, layer);
        return;
    }
    for (const auto& [name, value] : json.items()) {
        if (!value.is_string()) continue;
        if (const auto id = parse_hex(value.get<std::string>())) ids_[name] = *id;
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
    if (!damage_.empty()) throw Error(damage_);
    if (ids_.empty()) return cryptomatte_hash(name);
    const auto found = ids_.find(name);
    if (found != ids_.end()) return found->second;
    const auto known = names();
    throw Error(fmt::format("cryptomatte {} has no object \"{}\"; nearest: \"{}\"; objects: {}", layer_, name,
                            nearest_name(name, known), fmt::join(known, ", ")));
}

}  // namespace wrinkle
