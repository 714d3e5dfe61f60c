#include "io/light_pictures.h"

#include <algorithm>

#include "base/names.h"
#include "io/channel_index.h"

namespace wrinkle::io {

std::vector<std::string> light_pictures(std::span<const std::string> channels) {
    const ChannelIndex index(channels);
    const Role colours{"beauty", {"", "", ""}};
    std::vector<std::string> found;
    for (const std::string& layer : index.layers) {
        const std::string name = lower(layer.substr(layer.rfind('.') + 1));  // npos + 1 is 0
        const bool named = std::ranges::any_of(std::initializer_list<const char*>{"combined_", "rgba_", "lightselect_",
                                                                                  "vraylightselect_", "c_", "beauty_"},
                                               [&](const char* start) { return name.starts_with(start); });
        if (named && !index.match(colours, layer).empty()) found.push_back(layer);
    }
    return found;
}

}  // namespace wrinkle::io
