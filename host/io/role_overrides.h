#pragma once

#include "io/channel_index.h"
#include "io/gbuffer_roles.h"

namespace wrinkle::io {

/// Replaces channels that were detected by those that the user asked for; see detect_roles().
void apply_overrides(RoleMap& map, const ChannelIndex& index, const CryptomatteLayers& cryptomattes,
                     const std::map<std::string, std::string>& overrides);

/// Makes `ranks` the planes crypto.id0, crypto.coverage0 and so on, and drops those that were there before.
void assign_ranks(RoleMap& map, const std::string& layer, const std::vector<CryptomatteRank>& ranks);

}  // namespace wrinkle::io
