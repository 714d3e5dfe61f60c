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
        for (const std::string* name : {&light.picture, &light.diffuse, &light.specular})
            if (!name->empty() && std::ranges::find(pictures, *name) == pictures.end()) pictures.push_back(*name);
    return pictures;
}

LightPictures picture_numbers(const std::vector<std::string>& pictures, const Light& light, bool specular_apart,
                              std::size_t none) {
    const auto number = [&](const std::string& lobe, std::size_t without) {
        const std::string& name = lobe.empty() ? light.picture : lobe;
        if (name.empty()) return without;
        return static_cast<std::size_t>(std::ranges::find(pictures, name) - pictures.begin()) + 1;
    };
    return {number(light.diffuse, none), number(light.specular, specular_apart ? pictures.size() + 1 : none)};
}

std::vector<std::size_t> lights_read_apart(const Lighting& lighting, bool specular_apart) {
    std::vector<std::size_t> apart;
    if (lighting.relight != Relight::ratio || lighting.shadows != Shadows::read) return apart;
    if (lighting.table && !lighting.table->empty()) return apart;
    for (std::size_t i = 0; i < lighting.lights.size(); ++i) {
        const Light& light = lighting.lights[i];
        if (light.kind == LightKind::sky) continue;
        if (light.picture.empty() && light.diffuse.empty()) apart.push_back(i);
        // What is specular of such a light is in the rest of the picture, with no number of its own.
        else if (light.picture.empty() && light.specular.empty() && !specular_apart)
            return {};
    }
    const std::size_t before = pictures_of(lighting).size() + (specular_apart ? 1 : 0);
    if (apart.size() < 2 || apart.size() > kMostApart || before + apart.size() > kMostPictures) apart.clear();
    return apart;
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

namespace {

/// The first light that names a picture, and how, to start a message: scene.toml:12: light 2 has picture = "sun".
std::string who_wants(const Lighting& lighting, const std::string& picture) {
    for (std::size_t i = 0; i < lighting.lights.size(); ++i) {
        const Light& light = lighting.lights[i];
        for (const auto& [key, name] : {std::pair{"picture", &light.picture}, std::pair{"diffuse", &light.diffuse},
                                        std::pair{"specular", &light.specular}})
            if (*name == picture)
                return fmt::format("{}{}light {} has {} = {}", light.location, light.location.empty() ? "" : ": ",
                                   i + 1, key, quote(picture));
    }
    return fmt::format("a light has picture = {}", quote(picture));
}

}  // namespace

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
            "{}; {}", who_wants(emitter.scene.lighting, picture),
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

bool sums_light(const Emitter& emitter) {
    return emitter.scene.lighting.relight == Relight::ratio && emitter.available.beauty_scale > 1;
}

}  // namespace wrinkle
