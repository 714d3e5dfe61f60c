#include "io/frame_path.h"

#include <fmt/format.h>
#include <algorithm>
#include <cstdlib>
#include <optional>
#include <regex>
#include <string>

namespace wrinkle {
namespace {

struct FramePlace {
    std::size_t begin, length;
    int digits;
};

/// The last of: a run of "#"; "%d", "%4d", "%04d"; "$F", "$F4"; "<frame>", "<frame4>", "<frame04>".
std::optional<FramePlace> find_place(const std::string& name) {
    static const std::regex pattern(R"((#+)|%0?([0-9]{0,2})d|\$F([0-9]{0,2})(?![A-Za-z0-9])|<frame0?([0-9]{0,2})>)");
    std::optional<FramePlace> place;
    for (std::sregex_iterator match(name.begin(), name.end(), pattern), end; match != end; ++match) {
        int digits = std::max(1, static_cast<int>((*match)[1].length()));
        for (std::size_t width = 2; width < match->size(); ++width)
            if ((*match)[width].length() > 0) digits = std::stoi((*match)[width]);
        place = {static_cast<std::size_t>(match->position()), static_cast<std::size_t>(match->length()), digits};
    }
    return place;
}

}  // namespace

bool has_frame_place(const std::string& name) { return find_place(name).has_value(); }

std::string with_frame(std::string name, int frame) {
    const auto place = find_place(name);
    if (!place) return name;
    const auto number = fmt::format("{}{:0{}}", frame < 0 ? "-" : "", std::abs(frame), place->digits);
    return name.replace(place->begin, place->length, number);
}

bool has_frame_pattern(const std::filesystem::path& file) {
    std::error_code code;
    return has_frame_place(file.filename().string()) && !std::filesystem::exists(file, code);
}

std::filesystem::path frame_path(const std::filesystem::path& pattern, int frame) {
    if (!has_frame_pattern(pattern)) return pattern;
    return pattern.parent_path() / with_frame(pattern.filename().string(), frame);
}

}  // namespace wrinkle
