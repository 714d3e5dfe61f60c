#include "io/npy_header.h"

#include <fmt/format.h>

#include <regex>

#include "wrinkle/error.h"

namespace wrinkle::io {

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
    const std::string dict(text.substr(8 + counted, length));
    std::smatch type, order, shape;
    const bool plain = std::regex_search(dict, type, std::regex("'descr': *'([^']*)'"));
    if ((!plain && !std::regex_search(dict, type, std::regex("'descr': *\\[([^\\]]*)\\]"))) ||
        !std::regex_search(dict, order, std::regex("'fortran_order': *(True|False)")) ||
        !std::regex_search(dict, shape, std::regex("'shape': *\\(([0-9, ]*)\\)")))
        throw fail("it is neither a plain array of numbers nor one of records with named fields");
    (plain ? header.type : header.records) = type[1];
    header.fortran_order = order[1] == "True";
    const std::string sides = shape[1];
    const std::regex digits("[0-9]+");
    for (std::sregex_iterator side(sides.begin(), sides.end(), digits), end; side != end; ++side) {
        if (side->str().size() > 12) throw fail("the .npy file is damaged: no array is that large");
        header.shape.push_back(std::stoull(side->str()));
    }
    return header;
}

}  // namespace wrinkle::io
