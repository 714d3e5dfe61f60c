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
    std::vector<std::string> layers;                                       ///< in the file's order; "" for plain names
    std::map<std::string, std::map<std::string, std::string>> components;  ///< layer, lower-case component -> channel

    /// The channels of `layer` that make up the role, in the order of its planes; empty when some are missing.
    std::vector<std::string> match(const Role& role, const std::string& layer) const;
};

struct CryptomatteRank {
    std::string id, coverage;  ///< channels
};

/// Ranked layers CryptoObject00, 01, ... by their common stem: pairs (R, G), (B, A) in the order of rank.
using CryptomatteLayers = std::map<std::string, std::vector<CryptomatteRank>>;
CryptomatteLayers find_cryptomattes(const ChannelIndex& index);

}  // namespace wrinkle::io
