#include "io/frame_path.h"

#include <fmt/format.h>
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

/// The last run of "#", or the last "%d", "%4d", "%04d".
std::optional<FramePlace> find_place(const std::string& name) {
    static const std::regex pattern("#+|%0?([0-9]{0,2})d");
    std::optional<FramePlace> place;
    for (std::sregex_iterator match(name.begin(), name.end(), pattern), end; match != end; ++match) {
        const auto length = static_cast<std::size_t>(match->length());
        const auto digits = (*match)[1].matched && (*match)[1].length() > 0 ? std::stoi((*match)[1]) : 1;
        place = {static_cast<std::size_t>(match->position()), length,
                 name[static_cast<std::size_t>(match->position())] == '#' ? static_cast<int>(length) : digits};
    }
    return place;
}

}  // namespace

bool has_frame_pattern(const std::filesystem::path& file) {
    std::error_code code;
    return find_place(file.filename().string()).has_value() && !std::filesystem::exists(file, code);
}

std::filesystem::path frame_path(const std::filesystem::path& pattern, int frame) {
    if (!has_frame_pattern(pattern)) return pattern;
    auto name = pattern.filename().string();
    const auto place = find_place(name);
    const auto number = fmt::format("{}{:0{}}", frame < 0 ? "-" : "", std::abs(frame), place->digits);
    return pattern.parent_path() / name.replace(place->begin, place->length, number);
}

}  // namespace wrinkle
