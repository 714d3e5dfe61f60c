#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "io/metadata.h"

namespace wrinkle {

/// Cryptomatte's id of a name: MurmurHash3_32, its exponent bit flipped where the float would be zero, denormal, Inf
/// or NaN. The bits of the id channels.
std::uint32_t cryptomatte_hash(std::string_view name);

/// Names and ids of one cryptomatte, as its header lists them. Empty when the header has no manifest.
class CryptomatteManifest {
public:
    CryptomatteManifest() = default;
    /// The manifest of `layer` ("ViewLayer.CryptoObject") in the header of `file`, embedded or in a file beside it. One
    /// that is damaged is told when a name is asked for.
    CryptomatteManifest(const Metadata& header, const std::string& layer, const std::filesystem::path& file);

    std::vector<std::string> names() const;

    /// Id bits of an object's name, or of "#" and 8 hex digits. Throws Error when there is a manifest that lacks the
    /// name, or is damaged; without a manifest the name is hashed.
    std::uint32_t id(std::string_view name) const;

private:
    std::map<std::string, std::uint32_t, std::less<>> ids_;
    std::string layer_, damage_;
};

}  // namespace wrinkle
