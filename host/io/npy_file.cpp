#include "io/npy_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <regex>

#include "io/csv_table.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as they lie in the file");

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::size_t alignment = 64;

struct Header {
    std::string type;
    std::vector<std::size_t> shape;
    bool fortran_order = false;
    std::size_t data = 0;  ///< where the numbers begin
};

/// The text is a Python dict: {'descr': '<f4', 'fortran_order': False, 'shape': (3, 4), }
Header read_header(std::string_view text, const std::string& name) {
    const auto fail = [&](const char* what) { return Error(fmt::format("{}: {}", name, what)); };
    if (!text.starts_with(magic) || text.size() < 12) throw fail("not a .npy file");
    const auto byte = [&](std::size_t at) { return static_cast<std::size_t>(static_cast<unsigned char>(text[at])); };
    const std::size_t counted = byte(6) == 1 ? 2 : 4;  // bytes of the header's length, by version
    std::size_t length = 0;
    for (std::size_t i = 0; i < counted; ++i) length |= byte(8 + i) << (8 * i);
    Header header{.type = {}, .shape = {}, .data = 8 + counted + length};
    if (header.data > text.size() || length > 65535) throw fail("the .npy file is cut short or damaged");
    const std::string dict(text.substr(8 + counted, length));
    std::smatch type, order, shape;
    if (!std::regex_search(dict, type, std::regex("'descr': *'([^']*)'")) ||
        !std::regex_search(dict, order, std::regex("'fortran_order': *(True|False)")) ||
        !std::regex_search(dict, shape, std::regex("'shape': *\\(([0-9, ]*)\\)")))
        throw fail("it holds records or something else that is no plain array of numbers");
    header.type = type[1];
    header.fortran_order = order[1] == "True";
    const std::string sides = shape[1];
    const std::regex digits("[0-9]+");
    for (std::sregex_iterator side(sides.begin(), sides.end(), digits), end; side != end; ++side) {
        if (side->str().size() > 12) throw fail("the .npy file is damaged: no array is that large");
        header.shape.push_back(std::stoull(side->str()));
    }
    return header;
}

template <class Stored, class T>
void take(std::string_view bytes, std::vector<T>& values, const std::string& name) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        Stored stored;
        std::memcpy(&stored, bytes.data() + i * sizeof(Stored), sizeof(Stored));
        values[i] = static_cast<T>(stored);
        if (std::isinf(values[i]) && !std::isinf(stored))
            throw Error(
                fmt::format("{}: element {} is {}, too large for a float; use --precision double", name, i, stored));
    }
}

}  // namespace

template <class T>
NpyArray<T> read_npy(const std::filesystem::path& file) {
    const std::string text = read_text(file), name = file.string();
    const Header header = read_header(text, name);
    const std::size_t size = header.type == "<f4" ? 4 : header.type == "<f8" ? 8 : 0;
    if (size == 0)
        throw Error(
            fmt::format("{} holds numbers of type \"{}\"; needs \"<f4\" or \"<f8\": "
                        "array.astype(\"<f4\")",
                        name, header.type));
    if (header.fortran_order && header.shape.size() > 1)
        throw Error(fmt::format("{} is in Fortran order; save it in C order: numpy.ascontiguousarray(array)", name));
    const std::size_t there = (text.size() - header.data) / size;
    std::size_t count = 1;
    for (const std::size_t side : header.shape) {
        if (side != 0 && count > (std::size_t{1} << 48) / side)
            throw Error(fmt::format("{}: the .npy file is damaged: no array is that large", name));
        count *= side;
    }
    if (count > there) throw Error(fmt::format("{} is cut short: {} of {} numbers are there", name, there, count));
    NpyArray<T> array{header.shape, std::vector<T>(count)};
    const std::string_view bytes = std::string_view(text).substr(header.data);
    if (size == 4)
        take<float>(bytes, array.values, name);
    else
        take<double>(bytes, array.values, name);
    return array;
}

template NpyArray<float> read_npy(const std::filesystem::path&);
template NpyArray<double> read_npy(const std::filesystem::path&);

template <class T>
std::string npy_header(std::span<const std::size_t> shape) {
    std::string sides;
    for (const std::size_t side : shape) sides += fmt::format("{}, ", side);
    if (shape.size() > 1) sides.resize(sides.size() - 2);
    std::string dict = fmt::format("{{'descr': '<f{}', 'fortran_order': False, 'shape': ({}), }}", sizeof(T),
                                   shape.size() == 1 ? sides.substr(0, sides.size() - 1) : sides);
    dict.append(alignment - 1 - (magic.size() + 4 + dict.size()) % alignment, ' ');
    dict += '\n';
    std::string text(magic);
    text += {'\x01', '\x00', static_cast<char>(dict.size() & 255), static_cast<char>(dict.size() >> 8)};
    return text + dict;
}

template std::string npy_header<float>(std::span<const std::size_t>);
template std::string npy_header<double>(std::span<const std::size_t>);

}  // namespace wrinkle::io
