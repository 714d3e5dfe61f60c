#include "base/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <vector>

namespace wrinkle {
namespace {

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

struct Nearest {
    std::string name;
    std::size_t edits = std::numeric_limits<std::size_t>::max();
};

Nearest nearest(std::string_view name, std::span<const std::string> known) {
    const std::string wanted = lower(name);
    Nearest best;
    for (const std::string& candidate : known)
        if (const std::size_t edits = edit_distance(wanted, lower(candidate)); edits < best.edits)
            best = {candidate, edits};
    return best;
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

std::string nearest_name(std::string_view name, std::span<const std::string> known) {
    return nearest(name, known).name;
}

std::string did_you_mean(std::string_view name, std::span<const std::string> known) {
    constexpr std::size_t longest = 64;  // nobody means a name by such a text, and comparing takes its length squared
    if (name.size() > longest || known.empty()) return {};
    const Nearest best = nearest(name, known);
    const bool near = best.edits <= std::max<std::size_t>(1, std::min(name.size(), best.name.size()) / 3);
    return near ? fmt::format("; did you mean {}?", quote(best.name)) : std::string{};
}

}  // namespace wrinkle
