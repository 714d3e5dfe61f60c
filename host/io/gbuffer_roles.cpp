#include "io/gbuffer_roles.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <set>

#include "base/names.h"
#include "io/channel_index.h"
#include "io/channel_names.h"
#include "io/role_overrides.h"
#include "io/writer_names.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

using io::ChannelIndex;

std::pair<std::string, std::string> split_prefix(const std::string& layer) {
    const auto dot = layer.rfind('.');
    return dot == std::string::npos ? std::pair{std::string(), layer}
                                    : std::pair{layer.substr(0, dot), layer.substr(dot + 1)};
}

/// The channels of a role, in the view layer `prefix` or in none. Of several spellings the first one listed in
/// writer_names.cpp wins.
std::vector<std::string> find_role(const ChannelIndex& index, const Role& role, const std::string& prefix) {
    const auto& spellings = *std::ranges::find(io::role_names(), role.name, &io::RoleNames::role);
    for (const auto spelling : spellings.layers) {
        for (const auto& wanted : {prefix, std::string()}) {
            for (const auto& layer : index.layers) {
                const auto [layer_prefix, base] = split_prefix(layer);
                if (layer_prefix != wanted || io::plain_layer_name(base) != spelling) continue;
                if (base.starts_with("__") && (spelling == "p" || spelling == "nn")) continue;  // camera space
                if (auto found = index.match(role, layer); !found.empty()) return found;
            }
            const auto top = index.components.find(wanted);  // single channels without a component: "Z", "roughness"
            if (role.planes.size() != 1 || top == index.components.end()) continue;
            for (const auto& [component, channel] : top->second) {
                if (io::plain_layer_name(component) == spelling) return {channel};
            }
        }
    }
    // pbrt writes u, v and their derivatives without a layer.
    const auto top = index.components.find("");
    const auto pair = [&](const std::string& u, const std::string& v) -> std::vector<std::string> {
        if (top == index.components.end() || !top->second.contains(u) || !top->second.contains(v)) return {};
        return {top->second.at(u), top->second.at(v)};
    };
    if (role.name == "tangent_sign") {  // often the tangent's fourth component W, but not its A, which is coverage
        const auto tangent = std::ranges::find(gbuffer_roles(), "tangent", &Role::name);
        const auto channels = find_role(index, *tangent, prefix);
        if (channels.empty()) return {};
        const auto& all = index.components.at(io::split_channel(channels.front()).layer);
        if (const auto fourth = all.find("w"); fourth != all.end()) return {fourth->second};
    }
    if (role.name == "uv") return pair("u", "v");
    if (role.name == "duv_dx") return pair("dudx", "dvdx");
    if (role.name == "duv_dy") return pair("dudy", "dvdy");
    return {};
}

void assign(RoleMap& map, const Role& role, const std::vector<std::string>& channels) {
    for (std::size_t i = 0; i < channels.size(); ++i) map.channel_of[role.planes[i]] = channels[i];
}

/// A view layer, and how many roles it has, with those that no layer has.
struct ViewLayer {
    std::string prefix;
    std::size_t roles = 0;
    bool normal = false;  ///< of its own
};

std::vector<ViewLayer> view_layers(const ChannelIndex& index) {
    std::vector<ViewLayer> found;
    std::set<std::string> seen;
    for (const auto& layer : index.layers) {
        ViewLayer view{split_prefix(layer).first};
        if (!seen.insert(view.prefix).second) continue;
        for (const auto& role : gbuffer_roles()) {
            if (role.name == "cryptomatte") continue;
            const std::vector<std::string> channels = find_role(index, role, view.prefix);
            if (channels.empty()) continue;
            ++view.roles;
            const std::string from = split_prefix(io::split_channel(channels.front()).layer).first;
            view.normal = view.normal || (role.name == "normal" && from == view.prefix);
        }
        found.push_back(std::move(view));
    }
    return found;
}

/// The view layer that is wanted, else the one in which most roles are found.
std::string choose_prefix(const ChannelIndex& index, const GBufferSource& source) {
    const auto found = view_layers(index);
    std::vector<std::string> names;
    for (const auto& view : found) names.push_back(view.prefix);
    if (!source.layer.empty()) {
        if (std::ranges::find(names, source.layer) != names.end()) return source.layer;
        std::erase(names, "");
        throw Error(fmt::format("there is no view layer {}{}; channels found: {}", quote(source.layer),
                                names.empty() ? "" : "; there are " + quote_list(names),
                                io::describe_channels(index.channels)));
    }
    if (found.empty()) return "";
    const auto best = std::ranges::max_element(found, {}, &ViewLayer::roles);  // of several, the first
    // Layers of lights and the like also have a prefix, but no normals.
    const auto rival = std::ranges::find_if(best + 1, found.end(), [&](const ViewLayer& view) {
        return view.roles == best->roles && view.normal && best->normal;
    });
    if (rival != found.end() && !source.roles.contains("normal")) {
        const std::string &first = best->prefix, &second = rival->prefix;
        if (first.empty() || second.empty())
            throw Error(
                fmt::format("the layer {0} has the same passes as those without a layer; say which, as in [gbuffer] "
                            "layer = {0}, or roles = {{ normal = ... }} with the names of the others",
                            quote(first + second)));
        throw Error(fmt::format("the view layers {} and {} have the same passes; say which, as in [gbuffer] layer = {}",
                                quote(first), quote(second), quote(first)));
    }
    return best->roles == 0 ? "" : best->prefix;
}

/// In Mitsuba the user names the layers, and only the components' names are Mitsuba's own. A role is taken when exactly
/// one layer has its components.
void fill_mitsuba(RoleMap& map, const ChannelIndex& index) {
    std::set<std::string> taken;
    for (const auto& [plane, channel] : map.channel_of) taken.insert(io::split_channel(channel).layer);
    std::vector<std::string> ray, uv, object;
    for (const auto& layer : index.layers) {
        const auto& all = index.components.at(layer);
        if (layer.empty() || taken.contains(layer)) continue;
        if (all.contains("t") && all.size() == 1) ray.push_back(layer);
        if (all.contains("u") && all.contains("v") && all.size() == 2 && !layer.starts_with("duv")) uv.push_back(layer);
        if (all.contains("i") && all.size() == 1 && !contains_ignoring_case(layer, "prim")) object.push_back(layer);
    }
    const auto take = [&](const std::vector<std::string>& layers, std::string_view name) {
        const auto& role = *std::ranges::find(gbuffer_roles(), name, &Role::name);
        if (layers.size() == 1 && !map.has_role(name)) assign(map, role, index.match(role, layers.front()));
    };
    take(ray, "depth"), take(uv, "uv"), take(object, "object");
}

void assign_cryptomatte(RoleMap& map, const ChannelIndex& index, const io::CryptomatteLayers& found,
                        const std::string& prefix) {
    int best = -1;
    for (const auto& [stem, ranks] : found) {
        const auto [layer_prefix, base] = split_prefix(stem);
        // What stands before a dot is a view layer if other passes have it; else the Cryptomatte is called so.
        const bool of_view = std::ranges::any_of(index.layers, [&, &first = layer_prefix, &own = stem](const auto& l) {
            return split_prefix(l).first == first && !l.starts_with(own);
        });
        if (layer_prefix != prefix && !layer_prefix.empty() && of_view) continue;
        const int score = contains_ignoring_case(base, "object") ? 2 : contains_ignoring_case(base, "asset");
        if (score > best) best = score, io::assign_ranks(map, stem, ranks);
    }
}

/// Whether the normals in use are known to be in camera space.
bool in_camera_space(const RoleMap& map, NormalKind kind) {
    const auto normal = map.channel_of.find("normal.x");
    if (normal == map.channel_of.end() || kind != NormalKind::automatic) return kind == NormalKind::camera;
    const auto base = split_prefix(io::split_channel(normal->second).layer).second;
    return map.writer == Writer::vray && io::is_vray_camera_normal(io::plain_layer_name(base));
}

}  // namespace

const std::vector<Role>& gbuffer_roles() {
    static const std::vector<Role> roles{
        {"position", {"position.x", "position.y", "position.z"}},
        {"normal", {"normal.x", "normal.y", "normal.z"}},
        {"depth", {"depth"}},
        {"uv", {"uv.u", "uv.v"}},
        {"object", {"object"}},
        {"duv_dx", {"duv_dx.u", "duv_dx.v"}},
        {"duv_dy", {"duv_dy.u", "duv_dy.v"}},
        {"dp_du", {"dp_du.x", "dp_du.y", "dp_du.z"}},
        {"dp_dv", {"dp_dv.x", "dp_dv.y", "dp_dv.z"}},
        {"tangent", {"tangent.x", "tangent.y", "tangent.z"}},
        {"tangent_sign", {"tangent_sign"}},
        {"bitangent", {"bitangent.x", "bitangent.y", "bitangent.z"}},
        {"albedo", {"albedo.r", "albedo.g", "albedo.b"}},
        {"roughness", {"roughness"}},
        {"metallic", {"metallic"}},
        {"emission", {"emission.r", "emission.g", "emission.b"}},
        {"transmission", {"transmission.r", "transmission.g", "transmission.b"}},
        {"transmission_direct", {"transmission_direct.r", "transmission_direct.g", "transmission_direct.b"}},
        {"transmission_indirect", {"transmission_indirect.r", "transmission_indirect.g", "transmission_indirect.b"}},
        {"transmission_color", {"transmission_color.r", "transmission_color.g", "transmission_color.b"}},
        {"specular", {"specular.r", "specular.g", "specular.b"}},
        {"specular_direct", {"specular_direct.r", "specular_direct.g", "specular_direct.b"}},
        {"specular_indirect", {"specular_indirect.r", "specular_indirect.g", "specular_indirect.b"}},
        {"specular_color", {"specular_color.r", "specular_color.g", "specular_color.b"}},
        {"beauty", {"beauty.r", "beauty.g", "beauty.b"}},
        {"cryptomatte", {"crypto.id0", "crypto.coverage0"}},  // and further ranks, as many as the file has
    };
    return roles;
}

bool RoleMap::has_role(std::string_view role) const {
    const auto found = std::ranges::find(gbuffer_roles(), role, &Role::name);
    return found != gbuffer_roles().end() &&
           std::ranges::all_of(found->planes, [&](const std::string& plane) { return has_plane(plane); });
}

HeaderHints header_hints(const Metadata& header) {
    HeaderHints hints;
    for (const auto& name : header.names()) {
        if (name.starts_with("cryptomatte/") && name.ends_with("/name"))
            hints.cryptomattes.push_back(header.text(name).value_or(""));
        hints.vray = hints.vray || name.starts_with("vrayInfo");
        hints.mitsuba =
            hints.mitsuba || (name == "generatedBy" && header.text(name).value_or("").starts_with("Mitsuba"));
    }
    return hints;
}

RoleMap detect_roles(std::span<const std::string> channels, const GBufferSource& source, const HeaderHints& hints) {
    const ChannelIndex index(channels);
    RoleMap map;
    map.writer = hints.vray ? Writer::vray : hints.mitsuba ? Writer::mitsuba : io::recognise_writer(channels);
    const auto prefix = choose_prefix(index, source);
    for (const auto& role : gbuffer_roles()) {
        const bool parameter = role.name == "specular" && map.writer == Writer::unreal;  // a material's, no light
        if (role.name != "cryptomatte" && !parameter) assign(map, role, find_role(index, role, prefix));
    }
    if (map.writer == Writer::mitsuba) fill_mitsuba(map, index);
    const auto cryptomattes = io::find_cryptomattes(index, hints.cryptomattes);
    assign_cryptomatte(map, index, cryptomattes, prefix);
    io::apply_overrides(map, index, cryptomattes, source.roles);
    // What kind of depth and normals there are depends on the channels in use, so it is settled after the overrides.
    if (const auto depth = map.channel_of.find("depth"); depth != map.channel_of.end()) {
        const bool ray = map.writer == Writer::mitsuba && io::split_channel(depth->second).component == "T";
        map.depth = ray ? DepthKind::ray : DepthKind::planar;
    }
    if (source.depth != DepthKind::automatic) map.depth = source.depth;
    map.camera_space_normals = in_camera_space(map, source.normals);
    map.v_down = source.v == VDirection::automatic ? map.writer == Writer::mitsuba : source.v == VDirection::down;
    return map;
}

std::string_view writer_name(Writer writer) {
    switch (writer) {
        case Writer::blender:
            return "Blender Cycles";
        case Writer::mitsuba:
            return "Mitsuba 3";
        case Writer::pbrt:
            return "pbrt-v4";
        case Writer::renderman:
            return "RenderMan";
        case Writer::arnold:
            return "Arnold";
        case Writer::unreal:
            return "Unreal Movie Render Queue";
        case Writer::vray:
            return "V-Ray";
        case Writer::plain:
            break;
    }
    return "plain names";
}

}  // namespace wrinkle
