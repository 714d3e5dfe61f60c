#include "scene/problems.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "wrinkle/error.h"

namespace wrinkle::scene {
namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

/// Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before[j - 2] + 1);
        }
        std::swap(before, above);
        std::swap(above, row);
    }
    return above[b.size()];
}

}  // namespace

std::string Problems::location(std::uint32_t line) const {
    return line == 0 ? file_name_ : fmt::format("{}:{}", file_name_, line);
}

void Problems::throw_if_any() {
    if (found_.empty()) return;
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string text;
    for (const auto& [line, problem] : found_)
        text += fmt::format("{}{}: {}", text.empty() ? "" : "\n", location(line), problem);
    throw Error(text);
}

std::string quote(std::string_view text) {
    constexpr std::size_t longest = 80;
    std::string out = "\"";
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto c = static_cast<unsigned char>(text[i]);
        // A multi-byte character is kept whole: the cut waits for the next one to begin.
        if (i >= longest && (c & 0xC0) != 0x80) return out + "...\"";
        if (c < 0x20 || c == 0x7F)
            out += fmt::format("\\x{:02x}", c);
        else
            out += text[i];
    }
    return out + "\"";
}

std::string quote_list(std::span<const std::string> names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + quote(name);
    return out;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> known) {
    if (name.size() > 64) return {};
    const std::string* nearest = nullptr;
    std::size_t smallest = 0;
    for (const std::string& candidate : known) {
        const std::size_t distance = edit_distance(lower(name), lower(candidate));
        if (nearest && distance >= smallest) continue;
        nearest = &candidate;
        smallest = distance;
    }
    const bool near = nearest && smallest <= std::max<std::size_t>(1, std::min(name.size(), nearest->size()) / 3);
    return near ? fmt::format("; did you mean {}?", quote(*nearest)) : std::string{};
}

}  // namespace wrinkle::scene
