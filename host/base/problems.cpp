#include "base/problems.h"

#include <fmt/format.h>

#include <algorithm>

#include "wrinkle/error.h"

namespace wrinkle {

std::string Problems::location(std::uint32_t line) const {
    return line == 0 ? file_name_ : fmt::format("{}:{}", file_name_, line);
}

void Problems::throw_if_any() {
    if (found_.empty()) return;
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text;
    for (const auto& [line, problem] : found_) {
        const std::string place = location(line);
        text += fmt::format("{}{}{}{}", text.empty() ? "" : "\n", place, place.empty() ? "" : ": ", problem);
    }
    if (more_ > 0) text += fmt::format("\n{}: and {} more", file_name_, more_);
    throw Error(text);
}

}  // namespace wrinkle
