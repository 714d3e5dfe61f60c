#include "io/names.h"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <limits>
#include <numeric>

namespace wrinkle::io {
namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substituted = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

bool contains_ignoring_case(std::string_view text, std::string_view needle) {
    return lower(text).find(lower(needle)) != std::string::npos;
}

ChannelName split_channel(std::string_view channel) {
    const auto dot = channel.rfind('.');
    if (dot == std::string_view::npos) return {"", std::string(channel)};
    return {std::string(channel.substr(0, dot)), std::string(channel.substr(dot + 1))};
}

std::string describe_channels(std::span<const std::string> channels) {
    std::vector<ChannelName> layers;  // in the file's order, with the components of a layer joined
    for (const auto& channel : channels) {
        auto name = split_channel(channel);
        const bool groups = !name.layer.empty() && name.component.size() == 1;
        if (groups && !layers.empty() && layers.back().layer == name.layer && layers.back().component.size() < 4) {
            layers.back().component += name.component;
        } else {
            layers.push_back(std::move(name));
        }
    }
    std::string text;
    for (const auto& [layer, component] : layers) {
        text += fmt::format("{}{}{}{}", text.empty() ? "" : ", ", layer, layer.empty() ? "" : ".", component);
    }
    return text.empty() ? "none" : text;
}

std::string nearest_name(std::string_view name, std::span<const std::string> candidates) {
    std::string best;
    auto fewest = std::numeric_limits<std::size_t>::max();
    for (const auto& candidate : candidates) {
        const auto edits = edit_distance(lower(name), lower(candidate));
        if (edits < fewest) fewest = edits, best = candidate;
    }
    return best;
}

}  // namespace wrinkle::io
