#include "io/npy_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// What follows a key of the dict, without the spaces before it. Nothing when there is no such key.
//
// The dict is searched by hand: std::regex recurses once a character, and a header may have 65535.
std::optional<std::string_view> after(std::string_view dict, std::string_view key) {
    const std::size_t at = dict.find(key);
    if (at == std::string_view::npos) return {};
    dict.remove_prefix(at + key.size());
    dict.remove_prefix(std::min(dict.find_first_not_of(' '), dict.size()));
    return dict;
}

/// The text between `open`, which it has to begin with, and the next `close`.
std::optional<std::string_view> between(std::optional<std::string_view> text, char open, char close) {
    if (!text || !text->starts_with(open)) return {};
    const std::size_t end = text->find(close, 1);
    return end == std::string_view::npos ? std::nullopt : std::optional(text->substr(1, end - 1));
}

/// The whole numbers of a tuple such as "3, 4". Nothing when there is anything else in it.
std::optional<std::vector<std::size_t>> sides_of(std::string_view tuple) {
    constexpr std::size_t kMostDigits = 12;
    std::vector<std::size_t> sides;
    while (true) {
        tuple.remove_prefix(std::min(tuple.find_first_not_of(", "), tuple.size()));
        if (tuple.empty()) return sides;
        std::size_t side = 0;
        const auto [end, error] = std::from_chars(tuple.data(), tuple.data() + tuple.size(), side);
        const auto digits = static_cast<std::size_t>(end - tuple.data());
        if (digits == 0 || digits > kMostDigits || error != std::errc()) return {};
        sides.push_back(side);
        tuple.remove_prefix(digits);
    }
}

}  // namespace

std::size_t NpyHeader::count(const std::string& name) const {
    std::size_t count = 1;
    for (const std::size_t side : shape) {
        if (side != 0 && count > (std::size_t{1} << 48) / side)
            throw Error(fmt::format("{}: the .npy file is damaged: no array is that large", name));
        count *= side;
    }
    return count;
}

NpyHeader read_npy_header(std::string_view text, const std::string& name) {
    const auto fail = [&](const char* what) { return Error(fmt::format("{}: {}", name, what)); };
    if (!text.starts_with(npy_magic) || text.size() < 12) throw fail("not a .npy file");
    const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(text[at])); };
    // Version 1 stores the header's length in 2 bytes, later ones in 4.
    const std::size_t counted = byte(6) == 1 ? 2 : 4;
    std::size_t length = 0;
    for (std::size_t i = 0; i < counted; ++i) length |= byte(8 + i) << (8 * i);
    NpyHeader header{.type = {}, .records = {}, .shape = {}, .data = 8 + counted + length};
    if (header.data > text.size() || length > 65535) throw fail("the .npy file is cut short or damaged");
    const std::string_view dict = text.substr(8 + counted, length);
    const auto description = after(dict, "'descr':"), order = after(dict, "'fortran_order':");
    const auto type = between(description, '\'', '\''), records = between(description, '[', ']');
    const auto shape = between(after(dict, "'shape':"), '(', ')');
    if ((!type && !records) || !shape || !order || (!order->starts_with("True") && !order->starts_with("False")))
        throw fail("it is neither a plain array of numbers nor one of records with named fields");
    (type ? header.type : header.records) = type ? *type : *records;
    header.fortran_order = order->starts_with("True");
    auto sides = sides_of(*shape);
    if (!sides) throw fail("the .npy file is damaged: no array is that large");
    constexpr std::size_t kMostDimensions = 64;  // numpy's
    if (sides->size() > kMostDimensions) throw fail("the .npy file is damaged: no array has so many dimensions");
    header.shape = std::move(*sides);
    return header;
}

}  // namespace wrinkle::io
