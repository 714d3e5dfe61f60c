#include "io/light_pictures.h"

#include <algorithm>

#include "base/names.h"
#include "io/channel_index.h"

namespace wrinkle::io {

namespace {

/// Whether a layer shows a lobe of a light, as diffuse_key does, and not a lobe of all light, as diffuse_direct.
bool is_lobe(const std::string& name) {
    for (const std::string_view lobe : {"diffuse_", "specular_"}) {
        if (!name.starts_with(lobe) || name.size() == lobe.size()) continue;
        const std::string_view of = std::string_view(name).substr(lobe.size());
        return std::ranges::none_of(std::initializer_list<std::string_view>{"direct", "indirect", "albedo", "color",
                                                                            "filter", "roughness", "lighting"},
                                    [&](std::string_view other) { return of == other; });
    }
    return false;
}

}  // namespace

std::vector<std::string> light_pictures(std::span<const std::string> channels) {
    const ChannelIndex index(channels);
    const Role colours{"beauty", {"", "", ""}};
    std::vector<std::string> found;
    for (const std::string& layer : index.layers) {
        const std::string name = lower(layer.substr(layer.rfind('.') + 1));  // npos + 1 is 0
        const bool named = std::ranges::any_of(std::initializer_list<const char*>{"combined_", "rgba_", "lightselect_",
                                                                                  "vraylightselect_", "c_", "beauty_"},
                                               [&](const char* start) { return name.starts_with(start); });
        if ((named || is_lobe(name)) && !index.match(colours, layer).empty()) found.push_back(layer);
    }
    return found;
}

}  // namespace wrinkle::io
