#include "io/npy_records.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "base/input_file.h"
#include "base/names.h"
#include "base/text_file.h"
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

/// Takes what a list of fields is made of off its front. (std::regex would recurse once a character.)
class FieldList {
public:
    explicit FieldList(std::string_view list) : rest_(list) { skip_spaces(); }

    bool empty() const { return rest_.empty(); }
    std::string_view rest() const { return rest_; }
    void skip_spaces() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \n\t"), rest_.size())); }

    bool take(char c) {
        if (!rest_.starts_with(c)) return false;
        rest_.remove_prefix(1);
        return true;
    }

    /// A text in single quotes.
    std::optional<std::string_view> take_quoted() {
        const std::size_t end = rest_.find('\'', 1);
        if (!rest_.starts_with('\'') || end == std::string_view::npos) return {};
        const std::string_view text = rest_.substr(1, end - 1);
        rest_.remove_prefix(end + 1);
        return text;
    }

private:
    std::string_view rest_;
};

/// A type such as "<f4", as its field has it. Nothing for what is no such type.
std::optional<NpyRecords::Field> field_of(std::string_view name, std::string_view type) {
    constexpr std::size_t kMostDigits = 6;
    if (type.size() < 3 || type.size() > 2 + kMostDigits || std::string_view("<>|=").find(type[0]) == type.npos)
        return {};
    const std::string_view digits = type.substr(2);
    if (std::isalpha(static_cast<unsigned char>(type[1])) == 0 || digits.find_first_not_of("0123456789") != digits.npos)
        return {};
    std::size_t size = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), size);
    return NpyRecords::Field{std::string(name), type[1], size, 0};
}

/// Reads a list such as ('x', '<f4'), ('shape', '<U6'). Fields follow one another in a record; ('', '|V4') is a gap of
/// 4 bytes.
std::vector<NpyRecords::Field> read_fields(const std::string& text, std::size_t& stride, const std::string& name) {
    std::vector<NpyRecords::Field> fields;
    stride = 0;
    for (FieldList list(text); !list.empty(); list.skip_spaces()) {
        const auto from = list.rest();
        const bool opened = list.take('(');
        const auto field_name = opened ? list.take_quoted() : std::nullopt;
        const bool separated = field_name && list.take(',');
        list.skip_spaces();
        const auto type = separated ? list.take_quoted() : std::nullopt;
        auto field = type && list.take(')') ? field_of(*field_name, *type) : std::nullopt;
        if (!field)
            throw Error(fmt::format("{}: cannot read its fields from {} on; each must be one number or text", name,
                                    quote(from.substr(0, 40))));
        list.take(',');
        field->offset = stride;
        if (field->kind == 'U') field->size *= kCharacter;
        stride += field->size;
        if (field->kind == 'V' && field->name.empty()) continue;
        if (const std::string why = unreadable(*field, type->front()); !why.empty())
            throw Error(
                fmt::format("{}: the field {} has type \"{}\", which {}", name, quote(field->name), *type, why));
        fields.push_back(std::move(*field));
    }
    return fields;
}

}  // namespace

bool NpyRecords::is(const std::filesystem::path& file) {
    std::string start(npy_magic.size(), ' ');
    InputFile(file, "a table").read_at(0, start.data(), start.size());
    return start == npy_magic;
}

NpyRecords::NpyRecords(const std::filesystem::path& file) : bytes_(read_text(file, "an array (.npy)", kAnyLength)) {
    const std::string name = file.string();
    const NpyHeader header = read_npy_header(bytes_, name);
    if (!header.type.empty())
        throw Error(
            fmt::format("{} holds plain numbers ({}), whose columns have no names; needs records: "
                        "numpy.lib.recfunctions.unstructured_to_structured(array, names=[\"x\", \"y\", ...])",
                        name, quote(header.type)));
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
