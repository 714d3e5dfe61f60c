#include "io/writer_names.h"

#include <algorithm>
#include <array>

#include "io/channel_names.h"

#include "base/names.h"

namespace wrinkle::io {

std::span<const RoleNames> role_names() {
    // RenderMan's __P and __Nn are missing here on purpose, as they are in camera space; so is Pref, the rest pose.
    static const std::vector<RoleNames> names{
        {"position", {"position", "pworld", "worldposition", "worldpos", "pos", "pp", "p", "hitp"}},
        {"normal",
         {"shnormal", "shadingnormal", "ns", "normal", "worldnormal", "nworld", "normals", "nn", "sn", "n", "hitn",
          "bumpnormals", "geonormal", "geometricnormal", "gn", "ng"}},
        {"depth", {"depth", "worlddepth", "scenedepth", "zdepth", "z", "dd", "pz"}},
        {"uv", {"uv", "st", "uvs", "texcoord", "uvw"}},
        {"object", {"object", "indexob", "objectindex", "objectid", "shapeindex", "si", "id"}},
        {"duv_dx", {"duvdx"}},
        {"duv_dy", {"duvdy"}},
        {"dp_du", {"dpdu"}},
        {"dp_dv", {"dpdv"}},
        {"tangent", {"tangent", "worldtangent", "tangents", "tan", "mikktangent", "tangentworld"}},
        {"tangent_sign", {"tangentsign", "bitangentsign", "tangentw", "handedness"}},
        {"bitangent", {"bitangent", "worldbitangent", "bitangents", "binormal", "worldbinormal", "mikkbitangent"}},
        {"albedo", {"albedo", "diffcol", "basecolor", "diffusecolor", "diffusefilter", "denoisingalbedo"}},
        {"roughness", {"roughness", "specularroughness"}},
        {"metallic", {"metallic", "metalness", "metallness", "metal"}},
        {"emission", {"emission", "emit", "selfillumination", "vrayselfillumination"}},
        {"transmission", {"transmission", "refraction", "vrayrefraction"}},
        {"transmission_direct", {"transmissiondirect", "transdir"}},
        {"transmission_indirect", {"transmissionindirect", "transind"}},
        {"transmission_color", {"transmissioncolor", "transcol"}},
        {"specular", {"specular", "specularlighting"}},
        {"specular_direct", {"speculardirect", "glossydirect", "glossdir"}},
        {"specular_indirect", {"specularindirect", "glossyindirect", "glossind"}},
        {"specular_color", {"specularcolor", "glossycolor", "glosscol"}},
        {"beauty", {"beauty", "combined", "rgba", "rgb", "rgbcolor", "c", "ci", "image", "finalimage", ""}},
    };
    return names;
}

std::string_view role_of_layer(std::string_view plain_name) {
    for (const auto& [role, layers] : role_names())
        if (!plain_name.empty() && std::ranges::find(layers, plain_name) != layers.end()) return role;
    return {};
}

bool is_vray_camera_normal(std::string_view plain_name) {
    return plain_name == "normals" || plain_name == "bumpnormals";
}

std::string plain_layer_name(std::string_view base) {
    std::string name = lower(base);
    std::erase_if(name, [](char c) { return c == '_' || c == '-' || c == ' '; });
    for (const std::string_view prefix : {"finalimagemovierenderqueue", "movierenderqueue"}) {
        if (name.starts_with(prefix) && name.size() > prefix.size()) return name.substr(prefix.size());
    }
    return name;
}

std::vector<std::vector<std::string_view>> component_sets(std::string_view role, std::size_t planes) {
    if (planes == 1) return {{"z"}, {"t"}, {"v"}, {"x"}, {"r"}, {"i"}, {"y"}, {"red"}};
    if (planes == 2) return {{"u", "v"}, {"s", "t"}, {"x", "y"}, {"r", "g"}, {"red", "green"}};
    const std::vector<std::string_view> colour{"r", "g", "b"}, words{"red", "green", "blue"}, space{"x", "y", "z"};
    if (role == "albedo" || role == "beauty" || role == "emission" || role.starts_with("transmission") ||
        role.starts_with("specular"))
        return {colour, words, space};
    return {space, colour, words};
}

Writer recognise_writer(std::span<const std::string> channels) {
    const auto any = [&](auto&& test) { return std::ranges::any_of(channels, test); };
    const auto exactly = [&](std::string_view name) { return std::ranges::find(channels, name) != channels.end(); };
    const auto layer_ends = [&](std::string_view end) {
        return any([&](const std::string& channel) { return split_channel(channel).layer.ends_with(end); });
    };
    if (any([](const std::string& c) { return contains_ignoring_case(c, "MovieRenderQueue"); })) return Writer::unreal;
    if (any([](const std::string& c) { return c.starts_with("__"); })) return Writer::renderman;
    if (any([](const std::string& c) { return contains_ignoring_case(c, "bump_normals"); }) ||
        any([](const std::string& c) { return contains_ignoring_case(c, "vray"); }))
        return Writer::vray;
    for (const std::string_view pass : {".Position", ".Normal", ".IndexOB", ".Depth", ".UV"}) {
        if (layer_ends(pass)) return Writer::blender;
    }
    const auto mitsuba_only = [](const std::string& channel) {
        const auto [layer, component] = split_channel(channel);
        return !layer.empty() && (component == "T" || component == "I");
    };
    if (any(mitsuba_only) || layer_ends("sh_normal")) return Writer::mitsuba;
    if (exactly("Ns.X") && exactly("P.X")) return Writer::pbrt;
    if ((exactly("P.X") || exactly("P.R")) && (exactly("N.X") || exactly("N.R") || exactly("Z"))) return Writer::arnold;
    return Writer::plain;
}

}  // namespace wrinkle::io
