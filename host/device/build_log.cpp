#include "device/build_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <sstream>

namespace wrinkle {

namespace {

bool is_number(const std::string& text) {
    return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c); });
}

/// Takes ":NUMBER" off the end of `text`; empty where there is none.
std::string take_number(std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || !is_number(text.substr(colon + 1))) return {};
    const std::string number = text.substr(colon + 1);
    text.resize(colon);
    return number;
}

/// An error as "FILE:LINE: WHAT", of the two forms that compilers made of clang have: FILE:LINE:COLUMN: error: WHAT,
/// and error: FILE:LINE:COLUMN: WHAT.
std::string error_of(const std::string& line) {
    constexpr std::string_view mark = "error: ";
    const std::size_t at = line.find(mark);
    if (at == std::string::npos) return {};
    std::string place = line.substr(0, at), what = line.substr(at + mark.size());
    if (place.empty()) {
        const std::size_t end = what.find(": ");
        if (end == std::string::npos) return {};
        place = what.substr(0, end), what = what.substr(end + 2);
    } else {
        place.resize(place.find_last_not_of(": ") + 1);
    }
    take_number(place);
    const std::string row = take_number(place);
    return row.empty() ? std::string() : fmt::format("{}:{}: {}", place, row, what);
}

}  // namespace

std::string build_errors(const std::string& log) {
    std::istringstream lines(log);
    std::set<std::string> told;  // PoCL repeats itself
    std::string errors;
    for (std::string line; std::getline(lines, line);)
        if (const std::string error = error_of(line); !error.empty() && told.insert(error).second)
            errors += (errors.empty() ? "" : "\n") + error;
    return errors.empty() ? log : errors;
}

}  // namespace wrinkle
