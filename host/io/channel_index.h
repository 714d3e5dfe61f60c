#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "wrinkle/gbuffer.h"

namespace wrinkle::io {

/// The channels of a file by layer and component.
struct ChannelIndex {
    explicit ChannelIndex(std::span<const std::string> names);

    std::vector<std::string> channels;
    std::vector<std::string> layers;                                       ///< in the file's order; "" if it has none
    std::map<std::string, std::map<std::string, std::string>> components;  ///< layer, lower-case component -> channel

    /// The channels of `layer` that make up a role, in the order of the role's planes. Empty when one is missing.
    std::vector<std::string> match(const Role& role, const std::string& layer) const;
};

struct CryptomatteRank {
    std::string id, coverage;  ///< names of channels
};

/// Cryptomattes by the stem of their layers' names. Each layer (CryptoObject00, CryptoObject01 ...) holds two ranks, as
/// (R, G) and (B, A), in whatever order the file has them. They are those that the header describes, and those that
/// have "crypto" in their names.
using CryptomatteLayers = std::map<std::string, std::vector<CryptomatteRank>>;
CryptomatteLayers find_cryptomattes(const ChannelIndex& index, std::span<const std::string> described);

}  // namespace wrinkle::io
