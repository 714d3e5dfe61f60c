#include "plan/section.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/names.h"
#include "plan/light_pictures.h"
#include "plan/planned_numbers.h"
#include "plan/precision.h"
#include "wrinkle/error.h"

namespace wrinkle {

const std::vector<Value>& values() {
    static const std::vector<Value> all{
        {"valid", "wr_mask", {""}},
        {"marked", "wr_real", {""}},
        {"p", "wr_vec3", {".x", ".y", ".z"}},
        {"p_low", "wr_vec3", {".x", ".y", ".z"}},
        {"n", "wr_vec3", {".x", ".y", ".z"}},
        {"base", "wr_vec3", {".x", ".y", ".z"}},
        {"dp_dx", "wr_vec3", {".x", ".y", ".z"}},
        {"dp_dy", "wr_vec3", {".x", ".y", ".z"}},
        {"dn_dx", "wr_vec3", {".x", ".y", ".z"}},
        {"dn_dy", "wr_vec3", {".x", ".y", ".z"}},
        {"uv", "wr_texcoord", {".st.x", ".st.y", ".dx.x", ".dx.y", ".dy.x", ".dy.y"}},
        {"uv_valid", "wr_mask", {""}},
        {"vertex_tb", "wr_tangents", {".t.x", ".t.y", ".t.z", ".b.x", ".b.y", ".b.z"}},
        {"vertex_tb_valid", "wr_mask", {""}},
        {"g", "wr_vec3", {".x", ".y", ".z"}},
        {"dh_dp", "wr_vec3", {".x", ".y", ".z"}},
        {"spread", "wr_vec3", {".x", ".y", ".z"}},
        {"turning", "wr_vec3", {".x", ".y", ".z"}},
        {"lit_sky", "wr_vec3", {".x", ".y", ".z"}},
        {"lit_metal", "wr_vec3", {".x", ".y", ".z"}},
        {"lit_gloss", "wr_vec3", {".x", ".y", ".z"}},
        {"around", "wr_vec3", {".x", ".y", ".z"}},
    };
    static const std::vector<Value> with_lights = [] {
        std::vector<Value> values = all;
        const std::vector<const char*> parts{".x", ".y", ".z"};
        for (std::size_t k = 0; k <= kMostPictures; ++k) values.push_back({lit_name(k), "wr_vec3", parts});
        static std::vector<std::string> without_bumps;  // the names' letters stay where they are
        without_bumps.reserve(values.size());
        for (const Value& lit : std::vector(values)) {
            if (!std::string_view(lit.name).starts_with("lit")) continue;
            without_bumps.push_back(old_name(lit.name));
            values.push_back({without_bumps.back().c_str(), "wr_vec3", parts});
        }
        return values;
    }();
    return with_lights;
}

Precision Emitter::precision(const Layer& layer) const {
    const std::size_t index = index_of(layer);
    const std::vector<Precision>& wanted = options.precision.layers;
    return served(layer_precisions(kinds, scene, index, available.camera),
                  wanted.empty() ? Precision::standard : wanted.at(index));
}

Precision Emitter::geometry_precision() const { return served(geometry_precisions(), options.precision.geometry); }

std::size_t Emitter::texture(const TextureUse& use, TexelKind kind) {
    for (std::size_t i = 0; i < plan.textures.size(); ++i) {
        const PlannedTexture& known = plan.textures[i];
        TextureUse same = known.use;
        same.upscale = use.upscale;  // its texels are told by the kind
        if (known.kind == kind && same == use && known.region == std::array<double, 4>{0, 0, 1, 1}) return i;
    }
    plan.textures.push_back({use, kind});
    return plan.textures.size() - 1;
}

std::size_t Emitter::volume(const VolumeLayer& layer, TexelKind kind) {
    for (std::size_t i = 0; i < plan.textures.size(); ++i) {
        const PlannedTexture& known = plan.textures[i];
        if (known.kind == kind && known.use.file == layer.file && known.grid == layer.grid) return i;
    }
    plan.textures.push_back({.use = {.file = layer.file},
                             .kind = kind,
                             .grid = layer.grid,
                             .vectors = available.volumes.at({layer.file.string(), layer.grid}).vectors});
    return plan.textures.size() - 1;
}

std::vector<double> numbers_of(const PlannedNumbers& planned, const NumberSource& source) {
    std::vector<double> values = planned.of(source);
    if (values.size() != planned.count)
        throw Error(fmt::format("{}: {} numbers; the pass is made for {}", planned.name, values.size(), planned.count));
    for (const double value : values)
        if (!std::isfinite(static_cast<float>(value)))
            throw Error(
                fmt::format("{} is {}; it must be finite, and within the range of a float", planned.name, value));
    return values;
}

std::size_t Emitter::numbers(const Layer& layer, const std::string& what,
                             std::function<std::vector<double>(const Layer&, const NumberSource&)> of) {
    return add_numbers(*this, fmt::format("{} of {}", what, layer_label(layer)),
                       [index = index_of(layer), of = std::move(of)](const NumberSource& source) {
                           return of(source.scene.layers.at(index), source);
                       });
}

std::string Emitter::number(const Layer& layer, const std::string& what, std::function<double(const Layer&)> of) {
    return fmt::format("numbers[{}]", numbers(layer, what, [of = std::move(of)](const Layer& l, const NumberSource&) {
                           return std::vector{of(l)};
                       }));
}

std::string Emitter::vector(const Layer& layer, const std::string& what, std::function<Vec3(const Layer&)> of) {
    return fmt::format("wr_v3(numbers + {})",
                       numbers(layer, what, [of = std::move(of)](const Layer& l, const NumberSource&) {
                           const Vec3 v = of(l);
                           return std::vector(v.begin(), v.end());
                       }));
}

std::size_t Emitter::eye_place(const Layer& layer, std::function<EyePlace(const Layer&)> of) {
    plan.eye_places.push_back([index = index_of(layer), of = std::move(of)](const NumberSource& source) {
        return of(source.scene.layers.at(index));
    });
    return plan.eye_places.size() - 1;
}

void Emitter::need(const std::string& who, const std::vector<std::string>& planes) const {
    constexpr std::string_view channel = "channel:";
    std::vector<std::string> missing, roles, channels;
    std::ranges::remove_copy_if(planes, std::back_inserter(missing), [&](const auto& plane) { return has(plane); });
    if (missing.empty()) return;
    for (const std::string& plane : available.planes)
        if (plane.starts_with(channel))
            channels.push_back(plane.substr(channel.size()));
        else
            roles.push_back(plane);
    const auto listed = [](const std::vector<std::string>& names) {
        return names.empty() ? "nothing" : fmt::format("{}", fmt::join(names, ", "));
    };
    if (missing.front().starts_with(channel) && !channels.empty()) {
        const std::string name = missing.front().substr(channel.size());
        throw Error(fmt::format("{} needs the channel \"{}\"; nearest: \"{}\"; the G-buffer has {}", who, name,
                                nearest_name(name, channels), listed(channels)));
    }
    throw Error(
        fmt::format("{} needs {}; the G-buffer has {}; if another channel holds it, name that in [gbuffer] roles", who,
                    listed(missing), listed(roles)));
}

std::uint32_t cryptomatte_hash(const std::map<std::string, std::uint32_t>& all, const std::string& name,
                               const std::string& who) {
    if (name.size() == 9 && name[0] == '#' && name.find_first_not_of("0123456789abcdefABCDEF", 1) == std::string::npos)
        return static_cast<std::uint32_t>(std::stoul(name.substr(1), nullptr, 16));
    if (const auto known = all.find(name); known != all.end()) return known->second;
    std::string names;
    for (const auto& [other, hash] : all) names += (names.empty() ? "" : ", ") + other;
    throw Error(fmt::format("{} names the Cryptomatte object \"{}\"; the file knows {}", who, name,
                            names.empty() ? "no names: give its hash as # and 8 hex digits" : names));
}

std::string layer_label(const Layer& layer) {
    return fmt::format("{}{}layer \"{}\"", layer.location, layer.location.empty() ? "" : ": ", layer.name);
}

std::string row_place(const DecalsLayer& table, std::size_t row) {
    const std::uint32_t line = table.rows->at(row).line;
    if (table.file.empty()) return fmt::format("row {}", row);
    return line > 0 ? fmt::format("{}:{}", table.file.string(), line)
                    : fmt::format("{}: row {}", table.file.string(), row);
}

std::string identifier(const std::string& plane) {
    const bool own = !plane.starts_with("channel:");  // ours stay apart by themselves; of a file's names all is escaped
    std::string name;
    for (const char c : plane) {
        if (std::isalnum(static_cast<unsigned char>(c)))
            name += c;
        else if (own && (c == '.' || c == '_'))
            name += '_';
        else
            name += fmt::format("_{:02x}", static_cast<unsigned char>(c));
    }
    return "in_" + name;
}

}  // namespace wrinkle
