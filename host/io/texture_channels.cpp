#include "io/texture_channels.h"

#include <fmt/format.h>
#include <algorithm>

#include "base/names.h"
#include "io/channel_index.h"
#include "io/channel_names.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// Channels that could be the content, and what they are called.
struct Candidate {
    std::string name;  ///< of the layer, or of a single channel without one
    std::vector<std::string> channels;
};

const char* content_name(Content content) {
    const char* const names[] = {"heights", "normals", "slopes", "normals"};
    return names[static_cast<int>(content)];
}

bool is_alpha(const std::string& channel) {
    const auto name = lower(split_channel(channel).component);
    return name == "a" || name == "alpha" || name == "ar" || name == "ag" || name == "ab";
}

std::vector<std::string> matched(const ChannelIndex& index, const std::string& layer, std::size_t planes) {
    return index.match(Role{"normal", std::vector<std::string>(planes)}, layer);
}

/// The channels of a layer without its alpha, in the file's order.
std::vector<std::string> data_channels(const ChannelIndex& index, const std::string& layer) {
    std::vector<std::string> found;
    for (const auto& channel : index.channels)
        if (split_channel(channel).layer == layer && !is_alpha(channel)) found.push_back(channel);
    return found;
}

/// What a layer could give: three components or two for vectors; for heights the first of a colour, or any channel.
std::vector<Candidate> candidates_of(const ChannelIndex& index, const std::string& layer, Content content) {
    const auto three = matched(index, layer, 3), two = matched(index, layer, 2);
    const auto data = data_channels(index, layer);
    if (content == Content::normal && three.empty() && data.size() == 2) return {{layer, two.empty() ? data : two}};
    if (content == Content::normal || content == Content::object_normal) {
        if (three.empty()) return {};
        return {{layer, three}};
    }
    if (content == Content::slope) {
        if (!two.empty()) return {{layer, two}};
        if (data.size() >= 2 && data.size() <= 4) return {{layer, data}};
        return {};
    }
    if (!three.empty()) return {{layer, {three.front()}}};
    std::vector<Candidate> singles;
    for (const auto& channel : data)
        singles.push_back({data.size() == 1 && !layer.empty() ? layer : channel, {channel}});
    return singles;
}

bool is_called_so(const std::string& name, Content content) {
    const auto words = content == Content::height  ? std::vector{"height", "disp", "bump", "mask"}
                       : content == Content::slope ? std::vector{"slope", "deriv"}
                                                   : std::vector{"normal", "nrm"};
    return std::ranges::any_of(words, [&](const char* word) { return contains_ignoring_case(name, word); });
}

std::string listed(const std::vector<Candidate>& candidates) {
    std::vector<std::string> names;
    for (const auto& candidate : candidates)
        names.push_back(candidate.name.empty() ? fmt::format("{}", fmt::join(candidate.channels, " "))
                                               : candidate.name);
    return quote_list(names);
}

std::vector<std::string> of_layer(const ChannelIndex& index, const TextureUse& use, const std::string& file) {
    const auto found = candidates_of(index, use.layer, use.content);
    if (found.size() == 1) return found.front().channels;
    const bool channel = std::ranges::find(index.channels, use.layer) != index.channels.end();
    if (channel && use.content == Content::height) return {use.layer};
    throw Error(fmt::format(
        "{}: {} layer {}; channels found: {}", file,
        index.components.contains(use.layer) ? fmt::format("no {} in the", content_name(use.content)) : "there is no",
        quote(use.layer), describe_channels(index.channels)));
}

}  // namespace

std::vector<std::string> texture_channels(std::span<const std::string> names, const TextureUse& use,
                                          const std::string& file) {
    const ChannelIndex index(names);
    for (const auto& channel : use.channels)
        if (std::ranges::find(names, channel) == names.end())
            throw Error(fmt::format("{}: no channel {}{}; channels found: {}", file, quote(channel),
                                    did_you_mean(channel, index.channels), describe_channels(names)));
    if (!use.channels.empty()) return use.channels;
    if (!use.layer.empty()) return of_layer(index, use, file);
    // Files of maketx --bumpslopes are known by the names of their channels.
    if (index.components.contains("") && index.components.at("").contains("b1_dhds"))
        return {names.begin(), names.end()};
    std::vector<Candidate> all;
    for (const auto& layer : index.layers) {
        const auto found = candidates_of(index, layer, use.content);
        all.insert(all.end(), found.begin(), found.end());
    }
    if (all.size() == 1) return all.front().channels;
    if (std::ranges::all_of(names, is_alpha))
        throw Error(fmt::format("{}: has nothing but alpha, which is no bump", file));
    if (all.empty() && index.layers.size() == 1)
        return {names.begin(), names.end()};  // their number is told to be wrong
    std::vector<Candidate> by_name;
    std::ranges::copy_if(all, std::back_inserter(by_name),
                         [&](const auto& candidate) { return is_called_so(candidate.name, use.content); });
    if (by_name.size() == 1) return by_name.front().channels;
    const auto& several = by_name.empty() ? all : by_name;
    if (several.empty())
        throw Error(fmt::format("{}: no channels that could be {}; channels found: {}", file, content_name(use.content),
                                describe_channels(names)));
    throw Error(
        fmt::format("{}: {} could be the {}; say which, as in texture = {{ file = \"...\", layer = \"NAME\" }}, or "
                    "name the channels",
                    file, listed(several), content_name(use.content)));
}

}  // namespace wrinkle::io
