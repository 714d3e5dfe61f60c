#include "io/npy_file.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "base/names.h"
#include "base/only_errors.h"
#include "base/text_file.h"
#include "io/npy_header.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as they lie in the file");

constexpr std::size_t alignment = 64;

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

template <class T>
NpyArray<T> read_any_npy(const std::filesystem::path& file) {
    const std::string text = read_text(file, "an array (.npy)", kAnyLength), name = file.string();
    const NpyHeader header = read_npy_header(text, name);
    if (header.type.empty()) throw Error(fmt::format("{} holds records; needs a plain array of numbers", name));
    const std::size_t size = header.type == "<f4" ? 4 : header.type == "<f8" ? 8 : 0;
    if (size == 0)
        throw Error(fmt::format("{} holds numbers of type {}; needs \"<f4\" or \"<f8\": array.astype(\"<f4\")", name,
                                quote(header.type)));
    if (header.fortran_order && header.shape.size() > 1)
        throw Error(fmt::format("{} is in Fortran order; save it in C order: numpy.ascontiguousarray(array)", name));
    const std::size_t there = (text.size() - header.data) / size;
    const std::size_t count = header.count(name);
    if (count > there) throw Error(fmt::format("{} is cut short: {} of {} numbers are there", name, there, count));
    NpyArray<T> array{header.shape, std::vector<T>(count)};
    const std::string_view bytes = std::string_view(text).substr(header.data);
    if (size == 4)
        take<float>(bytes, array.values, name);
    else
        take<double>(bytes, array.values, name);
    return array;
}

}  // namespace

template <class T>
NpyArray<T> read_npy(const std::filesystem::path& file) {
    return only_errors(file.c_str(), [&] { return read_any_npy<T>(file); });
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
    dict.append(alignment - 1 - (npy_magic.size() + 4 + dict.size()) % alignment, ' ');
    dict += '\n';
    std::string text(npy_magic);
    text += {'\x01', '\x00', static_cast<char>(dict.size() & 255), static_cast<char>(dict.size() >> 8)};
    return text + dict;
}

template std::string npy_header<float>(std::span<const std::size_t>);
template std::string npy_header<double>(std::span<const std::size_t>);

}  // namespace wrinkle::io
