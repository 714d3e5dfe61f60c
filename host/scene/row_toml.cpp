#include "scene/row_toml.h"

#include <OpenImageIO/parallel.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include "base/names.h"
#include "base/text_file.h"
#include "scene/row_claim.h"
#include "scene/row_reader.h"
#include "scene/toml.h"
#include "wrinkle/decal_layers.h"
#include "wrinkle/error.h"
#include "wrinkle/lighting.h"

namespace wrinkle::scene {

namespace {

template <class Row>
using Columns = std::span<const Column<Row>>;  ///< of one key

template <class Row>
std::map<std::string_view, Columns<Row>> columns_by_key(const RowKind<Row>& kind) {
    std::map<std::string_view, Columns<Row>> keys;
    const Columns<Row> all = kind.columns;
    for (std::size_t first = 0; first < all.size(); first += std::max<std::size_t>(all[first].size, 1))
        keys[all[first].key] = all.subspan(first, std::max<std::size_t>(all[first].size, 1));
    return keys;
}

template <class Row>
void read_value(RowReader<Row>& reader, const Column<Row>& column, const toml::node& value) {
    if (value.is_string() && column.field != Field::number) {
        reader.read_text(column, value.as_string()->get());
    } else if (value.is_boolean() && column.field == Field::truth) {
        reader.read_number(column, value.as_boolean()->get() ? 1 : 0);
    } else if (const auto number = value.value<double>();
               value.is_number() && column.field == Field::number && std::isfinite(*number)) {
        reader.read_number(column, *number);
    } else {
        constexpr const char* wanted[] = {"must be a number", "must be a text in \"\"", "must be true or false"};
        reader.refuse(column, describe(value), wanted[static_cast<int>(column.field)]);
    }
}

/// A hint for an unknown key that is the name of a column of CSV.
template <class Row>
std::string unknown_key(const RowKind<Row>& kind, std::string_view key) {
    const auto column = std::ranges::find(kind.columns, key, &Column<Row>::name);
    if (column == kind.columns.end()) {
        std::vector<std::string> known;
        for (const auto& [name, columns] : columns_by_key(kind)) known.emplace_back(name);
        const std::string near = did_you_mean(key, known);
        return fmt::format("unknown key {}{} known keys: {}", quote(key), near.empty() ? ";" : near,
                           fmt::join(known, ", "));
    }
    std::vector<std::string_view> elements;
    const Columns<Row> columns = columns_by_key(kind).at(column->key);
    for (const Column<Row>& each : columns) elements.emplace_back(each.name);
    return fmt::format("{} is written {} = [{}]", quote(key), column->key, fmt::join(elements, ", "));
}

/// Reads the rows of one table into the reader.
template <class Row>
class TomlRows {
public:
    TomlRows(RowReader<Row>& reader, const RowKind<Row>& kind) : reader_(reader), kind_(kind) {}

    void read(const toml::table& row, std::uint32_t first_line) {
        const auto line_of = [&](const toml::source_region& at) { return at.begin.line + first_line - 1; };
        reader_.begin_row(line_of(row.source()));
        for (const auto& [key, value] : row) {
            line_ = line_of(key.source());
            reader_.go_to(line_);
            if (const auto columns = keys_.find(key.str()); columns != keys_.end())
                read_key(columns->second, value);
            else
                reader_.complain(line_, unknown_key(kind_, key.str()));
        }
        if (const char* required = kind_.columns.front().key; !row.contains(required))
            reader_.complain(line_of(row.source()), fmt::format("needs the key {}", quote(required)));
        reader_.end_row();
    }

private:
    void read_key(Columns<Row> columns, const toml::node& value) {
        const Column<Row>& first = columns.front();
        if (first.size == 0) return read_value(reader_, first, value);
        if (value.is_number() && std::ranges::count(kind_.uniform, std::string_view(first.key)) > 0) {
            for (const Column<Row>& column : columns) read_value(reader_, column, value);
            return;
        }
        const toml::array* array = value.as_array();
        if (array == nullptr || array->size() != columns.size())
            return reader_.complain(line_, fmt::format("{} is {}; it must be {} numbers in []", quote(first.key),
                                                       describe(value), columns.size()));
        for (std::size_t i = 0; i < columns.size(); ++i) read_value(reader_, columns[i], (*array)[i]);
    }

    RowReader<Row>& reader_;
    const RowKind<Row>& kind_;
    std::uint32_t line_ = 0;  ///< of the key being read
    std::map<std::string_view, Columns<Row>> keys_ = columns_by_key(kind_);
};

/// Part of a file.
struct Piece {
    std::string_view text;
    std::uint32_t first_line = 1;
    bool is_all = false;
};

/// The text in pieces of whole tables, which are parsed one by one: for a large text at once, toml++ takes far more
/// time and memory.
std::vector<Piece> pieces_of(std::string_view text, std::string_view row) {
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    const std::string start = fmt::format("\n[[{}]]", row);
    std::vector<Piece> pieces;
    // Within a string of several lines, a line that looks like the start of a table may be none.
    const bool whole = text.find("\"\"\"") != text.npos || text.find("'''") != text.npos;
    std::uint32_t line = 1;
    do {
        const std::size_t end = whole || text.size() < kPiece ? text.npos : text.find(start, kPiece);
        const std::string_view piece = text.substr(0, end == text.npos ? end : end + 1);
        pieces.push_back({piece, line, pieces.empty() && end == text.npos});
        line += static_cast<std::uint32_t>(std::ranges::count(piece, '\n'));
        text.remove_prefix(piece.size());
    } while (!text.empty());
    return pieces;
}

template <class Row>
void read_piece(RowReader<Row>& reader, const RowKind<Row>& kind, const std::string& name, const Piece& piece) {
    TomlRows<Row> rows(reader, kind);
    const toml::table table = parse_toml(piece.text, name, piece.first_line);
    for (const auto& [key, value] : table) {
        const std::uint32_t line = key.source().begin.line + piece.first_line - 1;
        const toml::array* array = value.as_array();
        if (key.str() != kind.name) {
            reader.complain_of_file(line, fmt::format("unknown key {}; a table of {}s holds [[{}]] only",
                                                      quote(key.str()), kind.name, kind.name));
        } else if (array == nullptr || !std::ranges::all_of(*array, &toml::node::is_table)) {
            reader.complain_of_file(line, fmt::format("\"{0}\" must be an array of tables: [[{0}]]", kind.name));
        } else {
            for (const toml::node& row : *array) rows.read(*row.as_table(), piece.first_line);
        }
    }
    if (piece.is_all && !table.contains(kind.name))
        reader.complain_of_file(0, fmt::format("holds no [[{}]], which needs at least {} = [x, y, z]", kind.name,
                                               kind.columns.front().key));
}

template <class Row>
std::string toml_value(const Column<Row>& column, const Row& row) {
    std::string text = column.write(row);
    if (text.empty() || column.field == Field::number) return text;
    std::ostringstream out;
    if (column.field == Field::truth)
        out << (text == "yes" ? "true" : "false");
    else
        out << toml::value<std::string>(std::move(text));
    return out.str();
}

/// The most rows that a text can hold.
std::size_t rows_of_toml(std::string_view text, const char* kind) {
    const std::string head = fmt::format("[[{}]]", kind);
    std::size_t rows = 0;
    for (std::size_t at = text.find(head); at != std::string_view::npos; at = text.find(head, at + head.size())) ++rows;
    return rows;
}

}  // namespace

bool is_toml(const std::filesystem::path& file) { return lower(file.extension().string()) == ".toml"; }

template <class Row>
std::vector<Row> load_row_toml(const std::filesystem::path& file, const RowKind<Row>& kind) {
    const std::string text = read_text(file, fmt::format("a table of {}s", kind.name), kAnyLength),
                      name = file.string();
    RowReader<Row> reader(name, kind, TableForm::toml);
    check_rows(file, claim_of(kind), rows_of_toml(text, kind.name), text.size());
    const std::vector<Piece> pieces = pieces_of(text, kind.name);
    std::vector<std::vector<Row>> sound(pieces.size());  // rows of pieces without mistakes
    OIIO::parallel_for(std::uint64_t{0}, std::uint64_t{pieces.size()}, [&](std::uint64_t i) {
        RowReader<Row> alone(name, kind, TableForm::toml);
        try {
            read_piece(alone, kind, name, pieces[i]);
            sound[i] = alone.finish();
        } catch (...) {  // read again below: messages count the rows before, which this piece does not know
        }
    });
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (sound[i].empty())
            read_piece(reader, kind, name, pieces[i]);
        else
            reader.append(std::exchange(sound[i], {}));
    return reader.finish();
}

template <class Row>
std::string row_toml(const RowKind<Row>& kind, std::span<const Column<Row>* const> columns,
                     const std::vector<Row>& rows) {
    const std::map<std::string_view, Columns<Row>> keys = columns_by_key(kind);
    std::string text;
    for (const Row& row : rows) {
        text += fmt::format("{}[[{}]]\n", text.empty() ? "" : "\n", kind.name);
        std::string_view last;
        for (const Column<Row>* column : columns) {
            if (column->key == last) continue;
            last = column->key;
            std::vector<std::string> values;
            for (const Column<Row>& each : keys.at(last)) values.push_back(toml_value(each, row));
            if (column->size > 0)
                text += fmt::format("{} = [{}]\n", last, fmt::join(values, ", "));
            else if (!values.front().empty())
                text += fmt::format("{} = {}\n", last, values.front());
        }
    }
    return text.empty() ? fmt::format("{} = []\n", kind.name) : text;
}

template std::vector<Projector> load_row_toml(const std::filesystem::path&, const RowKind<Projector>&);
template std::vector<Light> load_row_toml(const std::filesystem::path&, const RowKind<Light>&);
template std::string row_toml(const RowKind<Projector>&, std::span<const Column<Projector>* const>,
                              const std::vector<Projector>&);

}  // namespace wrinkle::scene
