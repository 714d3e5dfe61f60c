#include "io/views.h"

#include <fmt/format.h>
#include <algorithm>

#include "base/names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

std::vector<std::string> segments(std::string_view name) {
    std::vector<std::string> result;
    for (std::size_t from = 0; from <= name.size();) {
        const auto dot = std::min(name.find('.', from), name.size());
        result.emplace_back(name.substr(from, dot - from));
        from = dot + 1;
    }
    return result;
}

std::string joined(const std::vector<std::string>& parts) {
    std::string name;
    for (const auto& part : parts) name += (name.empty() ? "" : ".") + part;
    return name;
}

bool same(std::string_view a, std::string_view b) { return lower(a) == lower(b); }

bool is_eye(std::string_view name) { return same(name, "left") || same(name, "right"); }

void add(std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::none_of(names, [&](const auto& known) { return same(known, name); })) names.push_back(name);
}

std::string part_name(const OIIO::ImageSpec& spec) { return spec.get_string_attribute("oiio:subimagename"); }

/// The attribute of a part, else what its name says: "left", "N.right", or "N.main", as Nuke calls its only view.
std::string view_of_part(const OIIO::ImageSpec& spec, const std::vector<std::string>& known) {
    const std::string view = spec.get_string_attribute("view");
    if (!view.empty()) return view;
    const std::vector<std::string> all = segments(part_name(spec));
    for (const auto& segment : all)
        if (is_eye(segment) || std::ranges::any_of(known, [&](const auto& name) { return same(name, segment); }))
            return segment;
    if (all.size() > 1 && same(all.back(), "main")) return all.back();
    return "";
}

std::vector<std::string> multi_view(const OIIO::ImageSpec& spec) {
    std::vector<std::string> names;
    const auto* attribute = spec.find_attribute("multiView");
    if (attribute == nullptr || attribute->type().basetype != OIIO::TypeDesc::STRING) return names;
    for (int i = 0; i < static_cast<int>(attribute->type().numelements()); ++i)
        names.push_back(attribute->get_string_indexed(i));
    return names;
}

/// The view that a channel's name holds: a segment before the last, which is the component.
std::string view_of_channel(const std::string& channel, const std::vector<std::string>& views) {
    auto parts = segments(channel);
    parts.pop_back();
    for (const auto& part : parts)
        for (const auto& view : views)
            if (same(part, view)) return view;
    return "";
}

/// Views of channels that no attribute announces: left and right, or the one of them beside channels without a view.
std::vector<std::string> eyes_of_channels(const std::vector<OIIO::ImageSpec>& parts) {
    const std::vector<std::string> eyes{"left", "right"};
    bool found[2]{}, bare = false;
    for (const auto& spec : parts)
        for (const auto& channel : spec.channelnames) {
            const auto view = view_of_channel(channel, eyes);
            found[0] = found[0] || view == "left", found[1] = found[1] || view == "right";
            bare = bare || view.empty();
        }
    const bool stereo = (found[0] && found[1]) || (found[1] && bare);
    return stereo ? eyes : std::vector<std::string>{};
}

}  // namespace

bool Views::take(std::size_t part, std::string& channel) const {
    if (names.empty()) return true;
    const auto& of_part = part_views[part];
    if (!of_part.empty() && !same(of_part, chosen)) return false;
    if (!by_prefix) return true;
    const auto view = view_of_channel(channel, names);
    // Channels that name no view are those of the default one.
    if (!same(view.empty() ? names.front() : view, chosen)) return false;
    auto kept = segments(channel);
    std::erase_if(kept,
                  [&, last = kept.back()](const auto& segment) { return segment != last && same(segment, view); });
    channel = joined(kept);
    return true;
}

std::string Views::without_view(std::size_t part, const std::string& name) const {
    auto kept = segments(name);
    const auto& view = part_views.empty() ? std::string() : part_views[part];
    if (!view.empty()) std::erase_if(kept, [&](const auto& segment) { return same(segment, view); });
    return joined(kept);
}

Views find_views(const std::vector<OIIO::ImageSpec>& parts, const std::string& wanted,
                 const std::filesystem::path& file) {
    Views views;
    for (const auto& spec : parts)
        if (const std::string view = spec.get_string_attribute("view"); !view.empty()) add(views.names, view);
    for (const auto& spec : parts) {
        views.part_views.push_back(parts.size() > 1 ? view_of_part(spec, views.names) : "");
        if (!views.part_views.back().empty()) add(views.names, views.part_views.back());
    }
    if (parts.size() == 1) {
        auto named = multi_view(parts.front());
        if (named.size() < 2) named = eyes_of_channels(parts);
        if (named.size() > 1) views.names = named, views.by_prefix = true;
    } else if (views.names.empty()) {
        views.names = eyes_of_channels(parts);
        views.by_prefix = !views.names.empty();
    }
    if (!views.names.empty()) views.chosen = views.names.front();
    if (wanted.empty()) return views;
    const auto found = std::ranges::find_if(views.names, [&](const auto& name) { return same(name, wanted); });
    if (found == views.names.end())
        throw Error(fmt::format("{}: there is no view {}; {}", file.string(), quote(wanted),
                                views.names.empty() ? "the file has no views: remove [gbuffer] view"
                                                    : "its views are " + quote_list(views.names)));
    views.chosen = *found;
    return views;
}

}  // namespace wrinkle::io
