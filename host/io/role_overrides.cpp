#include "io/role_overrides.h"

#include <fmt/format.h>
#include <algorithm>

#include "base/names.h"
#include "io/channel_names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// All names that an override can take: those of channels and of layers.
std::vector<std::string> known_names(const ChannelIndex& index) {
    auto names = index.channels;
    std::ranges::copy_if(index.layers, std::back_inserter(names), [](const auto& layer) { return !layer.empty(); });
    return names;
}

[[noreturn]] void fail(const ChannelIndex& index, const std::string& key, const std::string& value,
                       const std::string& reason, const std::vector<std::string>& candidates) {
    const auto nearest = nearest_name(value, candidates);
    throw Error(fmt::format("roles: {} = \"{}\": {}{}; channels found: {}", key, value, reason,
                            nearest.empty() ? "" : fmt::format("; nearest name: \"{}\"", nearest),
                            describe_channels(index.channels)));
}

void erase_role(RoleMap& map, const Role& role) {
    for (const auto& plane : role.planes) map.channel_of.erase(plane);
    if (role.name == "cryptomatte") assign_ranks(map, "", {});
}

void override_cryptomatte(RoleMap& map, const ChannelIndex& index, const CryptomatteLayers& cryptomattes,
                          const std::string& value) {
    std::vector<std::string> stems;
    for (const auto& [stem, ranks] : cryptomattes) {
        if (stem == value || stem.ends_with("." + value)) return assign_ranks(map, stem, ranks);
        stems.push_back(stem);
    }
    fail(index, "cryptomatte", value, "no such cryptomatte (layers NAME00, NAME01 ... with R, G, B and A)", stems);
}

void override_role(RoleMap& map, const ChannelIndex& index, const Role& role, const std::string& value) {
    const bool channel = std::ranges::find(index.channels, value) != index.channels.end();
    if (role.planes.size() == 1 && channel) {
        map.channel_of[role.planes.front()] = value;
        return;
    }
    const auto matched = index.match(role, value);
    if (!matched.empty()) {
        for (std::size_t i = 0; i < matched.size(); ++i) map.channel_of[role.planes[i]] = matched[i];
        return;
    }
    const auto count = role.planes.size();
    if (channel || index.components.contains(value)) {
        fail(index, role.name, value,
             fmt::format("found, but {} needs {} component{} of a layer", role.name, count, count == 1 ? "" : "s"),
             known_names(index));
    }
    fail(index, role.name, value, "no such layer or channel", known_names(index));
}

}  // namespace

void assign_ranks(RoleMap& map, const std::string& layer, const std::vector<CryptomatteRank>& ranks) {
    std::erase_if(map.channel_of, [](const auto& entry) { return entry.first.starts_with("crypto."); });
    map.cryptomatte_layer = layer;
    map.cryptomatte_ranks = static_cast<int>(ranks.size());
    for (std::size_t i = 0; i < ranks.size(); ++i) {
        map.channel_of[fmt::format("crypto.id{}", i)] = ranks[i].id;
        map.channel_of[fmt::format("crypto.coverage{}", i)] = ranks[i].coverage;
    }
}

void apply_overrides(RoleMap& map, const ChannelIndex& index, const CryptomatteLayers& cryptomattes,
                     const std::map<std::string, std::string>& overrides) {
    for (const auto& [key, value] : overrides) {
        std::vector<std::string> keys;
        const Role* whole = nullptr;
        bool plane = false;
        for (const auto& role : gbuffer_roles()) {
            keys.push_back(role.name);
            if (role.name == key) whole = &role;
            plane = plane || (role.planes.size() > 1 && std::ranges::find(role.planes, key) != role.planes.end());
        }
        if (whole == nullptr && !plane) {
            throw Error(fmt::format("roles: \"{}\" is not a role; nearest: \"{}\"; roles: {}", key,
                                    nearest_name(key, keys), fmt::join(keys, ", ")));
        }
        if (whole == nullptr) {
            if (std::ranges::find(index.channels, value) == index.channels.end())
                fail(index, key, value, "no such channel", index.channels);
            map.channel_of[key] = value;
        } else if (value == "none") {
            erase_role(map, *whole);
        } else if (key == "cryptomatte") {
            override_cryptomatte(map, index, cryptomattes, value);
        } else {
            override_role(map, index, *whole, value);
        }
    }
}

}  // namespace wrinkle::io
