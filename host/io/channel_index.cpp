#include "io/channel_index.h"

#include <algorithm>
#include <array>
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

CryptomatteLayers find_cryptomattes(const ChannelIndex& index, std::span<const std::string> described) {
    const auto is_described = [&](const std::string& stem) {
        return std::ranges::any_of(described, [&](const std::string& name) {
            return !name.empty() && (stem == name || stem.ends_with("." + name) || name.ends_with("." + stem));
        });
    };
    std::map<std::string, std::map<int, std::array<CryptomatteRank, 2>>> found;  // by stem, then by the layer's number
    for (const auto& layer : index.layers) {
        const auto digits = layer.size() > 2 ? layer.substr(layer.size() - 2) : "";
        if (digits.empty() || !std::ranges::all_of(digits, [](unsigned char c) { return std::isdigit(c); })) continue;
        const auto stem = layer.substr(0, layer.size() - 2);
        if (!contains_ignoring_case(stem, "crypto") && !is_described(stem)) continue;
        const Role rgba{"beauty", {"", "", ""}};  // stands in for Cryptomatte: a role of three planes finds R, G and B
        const auto rgb = index.match(rgba, layer);
        const auto& all = index.components.at(layer);
        const auto alpha = all.contains("a") ? all.find("a") : all.find("alpha");
        if (rgb.size() != 3 || alpha == all.end()) continue;
        found[stem][std::stoi(digits)] = {{{rgb[0], rgb[1]}, {rgb[2], alpha->second}}};
    }
    CryptomatteLayers result;
    for (const auto& [stem, layers] : found) {
        int next = 0;
        for (const auto& [number, ranks] : layers) {
            if (number != next++) break;  // a layer is missing, so the numbers of the ranks after it would be wrong
            result[stem].insert(result[stem].end(), ranks.begin(), ranks.end());
        }
    }
    return result;
}

}  // namespace wrinkle::io
