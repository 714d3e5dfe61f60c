#include "plan/light_pictures.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/names.h"
#include "io/channel_index.h"
#include "wrinkle/error.h"

namespace wrinkle {

std::vector<std::string> pictures_of(const Lighting& lighting) {
    std::vector<std::string> pictures;
    for (const Light& light : lighting.lights)
        if (!light.picture.empty() && std::ranges::find(pictures, light.picture) == pictures.end())
            pictures.push_back(light.picture);
    return pictures;
}

std::size_t picture_number(const std::vector<std::string>& pictures, const Light& light) {
    if (light.picture.empty()) return 0;
    return static_cast<std::size_t>(std::ranges::find(pictures, light.picture) - pictures.begin()) + 1;
}

const char* lit_name(std::size_t picture) {
    static constexpr std::array<const char*, kMostPictures + 1> names{
        "lit",   "lit_1",  "lit_2",  "lit_3",  "lit_4",  "lit_5",  "lit_6",  "lit_7", "lit_8",
        "lit_9", "lit_10", "lit_11", "lit_12", "lit_13", "lit_14", "lit_15", "lit_16"};
    if (picture >= names.size())
        throw Error(fmt::format(
            "lights have more than {} different pictures; give lights whose pictures matter less none", kMostPictures));
    return names[picture];
}

std::array<std::string, 3> picture_planes(const Emitter& emitter, const std::string& picture) {
    constexpr std::string_view prefix = "channel:";
    std::vector<std::string> channels, layers, found;
    for (const std::string& plane : emitter.available.planes)
        if (plane.starts_with(prefix)) channels.push_back(plane.substr(prefix.size()));
    const io::ChannelIndex index(channels);
    const Role colours{"beauty", {"", "", ""}};
    for (const std::string& layer : index.layers) {
        if (index.match(colours, layer).empty()) continue;
        layers.push_back(layer);
        if (layer == picture) found = {layer};
        if (layer.ends_with("." + picture) && (found.empty() || found.front() != picture)) found.push_back(layer);
    }
    if (found.size() != 1)
        throw Error(fmt::format(
            "a [[light]] has picture = {}; {}", quote(picture),
            found.empty()
                ? (layers.empty() ? std::string("no layer of the frame has R, G and B")
                                  : fmt::format("no layer with R, G and B has that name; nearest: {}; there are {}",
                                                quote(nearest_name(picture, layers)), quote_list(layers)))
                : fmt::format("layers of that name are {}; say which", quote_list(found))));
    std::array<std::string, 3> planes;
    std::ranges::transform(index.match(colours, found.front()), planes.begin(),
                           [&](const std::string& channel) { return std::string(prefix) + channel; });
    return planes;
}

}  // namespace wrinkle
