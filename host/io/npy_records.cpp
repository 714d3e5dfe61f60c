#include "io/npy_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <regex>

#include "io/csv_table.h"
#include "io/npy_header.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as they lie in the file");

constexpr std::size_t kCharacter = 4;  // bytes a character in fields of kind U
constexpr std::size_t kLongest = 1 << 16;

template <class T>
double as_double(const char* bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

/// Why a field cannot be read, or nothing.
std::string unreadable(const NpyRecords::Field& field, char order) {
    const bool whole = field.kind == 'i' || field.kind == 'u';
    const bool sound = field.is_text() || (field.kind == 'b' && field.size == 1) ||
                       (field.kind == 'f' && (field.size == 4 || field.size == 8)) ||
                       (whole && std::has_single_bit(field.size) && field.size <= 8);
    if (!sound || field.size > kLongest) return "needs numbers of 4 or 8 bytes, whole numbers, bool, or text (S, U)";
    return order == '>' ? "is big-endian: array.astype(array.dtype.newbyteorder(\"<\"))" : "";
}

/// Reads a list such as ('x', '<f4'), ('shape', '<U6'). Fields follow one another in a record; ('', '|V4') is a gap of
/// 4 bytes.
std::vector<NpyRecords::Field> read_fields(const std::string& list, std::size_t& stride, const std::string& name) {
    static const std::regex pattern(R"(\s*\('([^']*)', *'([<>|=])([a-zA-Z])([0-9]{1,6})'\),?)");
    std::vector<NpyRecords::Field> fields;
    stride = 0;
    std::smatch part;
    for (auto rest = list.begin(); std::find_if_not(rest, list.end(), [](char c) { return c == ' '; }) != list.end();) {
        if (!std::regex_search(rest, list.end(), part, pattern, std::regex_constants::match_continuous))
            throw Error(fmt::format("{}: cannot read its fields from \"{}\" on; each must be one number or text", name,
                                    std::string(rest, list.end()).substr(0, 40)));
        rest = part[0].second;
        NpyRecords::Field field{part[1], part[3].str()[0], std::stoul(part[4]), stride};
        if (field.kind == 'U') field.size *= kCharacter;
        stride += field.size;
        if (field.kind == 'V' && field.name.empty()) continue;
        if (const std::string why = unreadable(field, part[2].str()[0]); !why.empty())
            throw Error(fmt::format("{}: the field \"{}\" has type \"{}{}{}\", which {}", name, field.name,
                                    part[2].str(), part[3].str(), part[4].str(), why));
        fields.push_back(field);
    }
    return fields;
}

}  // namespace

bool NpyRecords::is(const std::filesystem::path& file) {
    std::string start(npy_magic.size(), ' ');
    std::ifstream(file, std::ios::binary).read(start.data(), static_cast<std::streamsize>(start.size()));
    return start == npy_magic;
}

NpyRecords::NpyRecords(const std::filesystem::path& file) : bytes_(read_text(file)) {
    const std::string name = file.string();
    const NpyHeader header = read_npy_header(bytes_, name);
    if (!header.type.empty())
        throw Error(
            fmt::format("{} holds plain numbers (\"{}\"), whose columns have no names; needs records: "
                        "numpy.lib.recfunctions.unstructured_to_structured(array, names=[\"x\", \"y\", ...])",
                        name, header.type));
    if (header.shape.size() != 1)
        throw Error(fmt::format("{} has {} dimensions; a table has 1: array.ravel()", name, header.shape.size()));
    fields_ = read_fields(header.records, stride_, name);
    data_ = header.data, rows_ = header.count(name);
    const std::size_t there = stride_ > 0 ? (bytes_.size() - data_) / stride_ : 0;
    if (rows_ > there) throw Error(fmt::format("{} is cut short: {} of {} records are there", name, there, rows_));
}

double NpyRecords::number(std::size_t row, const Field& field) const {
    const char* bytes = at(row, field);
    if (field.kind == 'f') return field.size == 4 ? as_double<float>(bytes) : as_double<double>(bytes);
    if (field.kind == 'b') return *bytes != 0 ? 1 : 0;
    const bool is_signed = field.kind == 'i';
    switch (field.size) {
        case 1:
            return is_signed ? as_double<std::int8_t>(bytes) : as_double<std::uint8_t>(bytes);
        case 2:
            return is_signed ? as_double<std::int16_t>(bytes) : as_double<std::uint16_t>(bytes);
        case 4:
            return is_signed ? as_double<std::int32_t>(bytes) : as_double<std::uint32_t>(bytes);
        default:
            return is_signed ? as_double<std::int64_t>(bytes) : as_double<std::uint64_t>(bytes);
    }
}

std::string NpyRecords::text(std::size_t row, const Field& field) const {
    const char* bytes = at(row, field);
    std::string out;
    const std::size_t step = field.kind == 'U' ? kCharacter : 1;
    for (std::size_t i = 0; i < field.size; i += step) {
        std::uint32_t code = 0;
        std::memcpy(&code, bytes + i, step);
        out += step == 1 || code < 128 ? static_cast<char>(code) : '?';
    }
    return out.substr(0, out.find_last_not_of('\0') + 1);  // padded with zeros
}

}  // namespace wrinkle::io
