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

/// The view layer in which most roles are found; of several, the first.
std::string choose_prefix(const ChannelIndex& index) {
    std::string best;
    std::size_t most = 0;
    std::set<std::string> seen;
    for (const auto& layer : index.layers) {
        const auto prefix = split_prefix(layer).first;
        if (!seen.insert(prefix).second) continue;
        std::size_t count = 0;
        for (const auto& role : gbuffer_roles()) {
            if (role.name != "cryptomatte") count += !find_role(index, role, prefix).empty();
        }
        if (count > most) most = count, best = prefix;
    }
    return best;
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

void assign_cryptomatte(RoleMap& map, const ChannelIndex& index, const std::string& prefix) {
    const auto found = io::find_cryptomattes(index);
    int best = -1;
    for (const auto& [stem, ranks] : found) {
        const auto [layer_prefix, base] = split_prefix(stem);
        if (layer_prefix != prefix && !layer_prefix.empty()) continue;
        const int score = contains_ignoring_case(base, "object") ? 2 : contains_ignoring_case(base, "asset");
        if (score > best) best = score, io::assign_ranks(map, stem, ranks);
    }
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

RoleMap detect_roles(std::span<const std::string> channels, const std::map<std::string, std::string>& overrides) {
    const ChannelIndex index(channels);
    RoleMap map;
    map.writer = io::recognise_writer(channels);
    const auto prefix = choose_prefix(index);
    for (const auto& role : gbuffer_roles()) {
        if (role.name != "cryptomatte") assign(map, role, find_role(index, role, prefix));
    }
    if (map.writer == Writer::mitsuba) fill_mitsuba(map, index);
    assign_cryptomatte(map, index, prefix);
    io::apply_overrides(map, index, overrides);
    // What kind of depth and normals there are depends on the channels in use, so it is settled after the overrides.
    if (const auto depth = map.channel_of.find("depth"); depth != map.channel_of.end()) {
        const bool ray = map.writer == Writer::mitsuba && io::split_channel(depth->second).component == "T";
        map.depth = ray ? DepthKind::ray : DepthKind::planar;
    }
    if (const auto normal = map.channel_of.find("normal.x"); normal != map.channel_of.end()) {
        map.screen_space_normals = contains_ignoring_case(normal->second, "bump_normals");
    }
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
