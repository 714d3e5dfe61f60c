#include "io/channel_index.h"

#include <algorithm>
#include <cctype>

#include "base/names.h"
#include "io/channel_names.h"
#include "io/writer_names.h"

namespace wrinkle::io {

ChannelIndex::ChannelIndex(std::span<const std::string> names) : channels(names.begin(), names.end()) {
    for (const auto& channel : channels) {
        const auto name = split_channel(channel);
        auto [place, fresh] = components.try_emplace(name.layer);
        if (fresh) layers.push_back(name.layer);
        place->second.try_emplace(lower(name.component), channel);
    }
}

std::vector<std::string> ChannelIndex::match(const Role& role, const std::string& layer) const {
    const auto found = components.find(layer);
    if (found == components.end()) return {};
    for (const auto& set : component_sets(role.name, role.planes.size())) {
        std::vector<std::string> matched;
        for (const auto& component : set) {
            const auto channel = found->second.find(std::string(component));
            if (channel != found->second.end()) matched.push_back(channel->second);
        }
        if (matched.size() == role.planes.size()) return matched;
    }
    return {};
}

CryptomatteLayers find_cryptomattes(const ChannelIndex& index) {
    CryptomatteLayers result;
    for (const auto& layer : index.layers) {
        const auto digits = layer.size() >= 2 ? layer.substr(layer.size() - 2) : "";
        if (!contains_ignoring_case(layer, "crypto") ||
            !std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c); }) || digits.empty())
            continue;
        const auto stem = layer.substr(0, layer.size() - 2);
        const Role rgba{"beauty", {"", "", ""}};  // stands in for Cryptomatte: a role of three planes finds R, G and B
        const auto rgb = index.match(rgba, layer);
        const auto& all = index.components.at(layer);
        const auto alpha = all.contains("a") ? all.find("a") : all.find("alpha");
        if (rgb.size() != 3 || alpha == all.end()) continue;
        auto& ranks = result[stem];
        const auto first = 2 * static_cast<std::size_t>(std::stoi(digits));
        if (first != ranks.size()) continue;  // a rank is missing before this one, so its number would be wrong
        ranks.push_back({rgb[0], rgb[1]});
        ranks.push_back({rgb[2], alpha->second});
    }
    return result;
}

}  // namespace wrinkle::io
