#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/metadata.h"

namespace wrinkle {

/// Cryptomatte's id of a name, as the id channels hold its bits: MurmurHash3_32, with one bit of the exponent flipped
/// where the float would be zero, denormal, Inf or NaN.
std::uint32_t cryptomatte_hash(std::string_view name);

namespace io {

/// Whether a name stands for all that it matches: * for any text, ? for one character.
bool is_name_pattern(const std::string& name);
/// Whether an object is called so. Hashes ("#...") are no names.
bool matches_name(const std::string& pattern, const std::string& name);

}  // namespace io

/// Names and ids of one cryptomatte, as its header lists them. Empty when the header has no manifest.
class CryptomatteManifest {
public:
    CryptomatteManifest() = default;
    /// The manifest of `layer` ("ViewLayer.CryptoObject") that the header of `file` holds, or names as a file in the
    /// same folder. Of a damaged one, those entries are taken that can be read.
    CryptomatteManifest(const Metadata& header, const std::string& layer, const std::filesystem::path& file);

    std::vector<std::string> names() const;

    /// The id's bits, of an object's name or of "#" and 8 hex digits. Without a manifest, or with a damaged one that
    /// lacks it, the name is hashed. Throws Error when the manifest has no such name.
    std::uint32_t id(std::string_view name) const;

private:
    std::map<std::string, std::uint32_t, std::less<>> ids_;
    std::string layer_;
    bool damaged_ = false;
};

}  // namespace wrinkle
