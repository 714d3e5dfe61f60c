#include "scene/decal_toml.h"

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
#include "scene/decal_reader.h"
#include "scene/toml.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {

namespace {

using Columns = std::span<const DecalColumn>;  ///< of one key

/// Keys of which one number may stand for every element.
constexpr std::string_view kUniform[] = {"half_size", "falloff", "repeat"};

std::map<std::string_view, Columns> columns_by_key() {
    std::map<std::string_view, Columns> keys;
    const Columns all = decal_columns();
    for (std::size_t first = 0; first < all.size(); first += std::max<std::size_t>(all[first].size, 1))
        keys[all[first].key] = all.subspan(first, std::max<std::size_t>(all[first].size, 1));
    return keys;
}

void read_value(DecalReader& reader, const DecalColumn& column, const toml::node& value) {
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
std::string unknown_key(std::string_view key) {
    const auto column = std::ranges::find(decal_columns(), key, &DecalColumn::name);
    if (column == decal_columns().end()) {
        std::vector<std::string> known;
        for (const auto& [name, columns] : columns_by_key()) known.emplace_back(name);
        const std::string near = did_you_mean(key, known);
        return fmt::format("unknown key {}{} known keys: {}", quote(key), near.empty() ? ";" : near,
                           fmt::join(known, ", "));
    }
    std::vector<std::string_view> elements;
    const Columns columns = columns_by_key().at(column->key);
    for (const DecalColumn& each : columns) elements.emplace_back(each.name);
    return fmt::format("{} is written {} = [{}]", quote(key), column->key, fmt::join(elements, ", "));
}

/// Reads the decals of one table into the reader.
class RowReader {
public:
    explicit RowReader(DecalReader& reader) : reader_(reader) {}

    void read(const toml::table& decal, std::uint32_t first_line) {
        const auto line_of = [&](const toml::source_region& at) { return at.begin.line + first_line - 1; };
        reader_.begin_row(line_of(decal.source()));
        for (const auto& [key, value] : decal) {
            line_ = line_of(key.source());
            reader_.go_to(line_);
            if (const auto columns = keys_.find(key.str()); columns != keys_.end())
                read_key(columns->second, value);
            else
                reader_.complain(line_, unknown_key(key.str()));
        }
        if (const char* required = decal_columns().front().key; !decal.contains(required))
            reader_.complain(line_of(decal.source()), fmt::format("needs the key {}", quote(required)));
        reader_.end_row();
    }

private:
    void read_key(Columns columns, const toml::node& value) {
        const DecalColumn& first = columns.front();
        if (first.size == 0) return read_value(reader_, first, value);
        if (value.is_number() && std::ranges::count(kUniform, std::string_view(first.key)) > 0) {
            for (const DecalColumn& column : columns) read_value(reader_, column, value);
            return;
        }
        const toml::array* array = value.as_array();
        if (array == nullptr || array->size() != columns.size())
            return reader_.complain(line_, fmt::format("{} is {}; it must be {} numbers in []", quote(first.key),
                                                       describe(value), columns.size()));
        for (std::size_t i = 0; i < columns.size(); ++i) read_value(reader_, columns[i], (*array)[i]);
    }

    DecalReader& reader_;
    std::uint32_t line_ = 0;  ///< of the key being read
    std::map<std::string_view, Columns> keys_ = columns_by_key();
};

/// Part of a file.
struct Piece {
    std::string_view text;
    std::uint32_t first_line = 1;
    bool is_all = false;
};

/// The text in pieces of whole tables, which are parsed one by one: for a large text at once, toml++ takes far more
/// time and memory.
std::vector<Piece> pieces_of(std::string_view text) {
    constexpr std::size_t kPiece = std::size_t{1} << 16;
    constexpr std::string_view kStart = "\n[[decal]]";
    std::vector<Piece> pieces;
    // Within a string of several lines, a line that looks like the start of a table may be none.
    const bool whole = text.find("\"\"\"") != text.npos || text.find("'''") != text.npos;
    std::uint32_t line = 1;
    do {
        const std::size_t end = whole || text.size() < kPiece ? text.npos : text.find(kStart, kPiece);
        const std::string_view piece = text.substr(0, end == text.npos ? end : end + 1);
        pieces.push_back({piece, line, pieces.empty() && end == text.npos});
        line += static_cast<std::uint32_t>(std::ranges::count(piece, '\n'));
        text.remove_prefix(piece.size());
    } while (!text.empty());
    return pieces;
}

void read_piece(DecalReader& reader, const std::string& name, const Piece& piece) {
    RowReader rows(reader);
    const toml::table table = parse_toml(piece.text, name, piece.first_line);
    for (const auto& [key, value] : table) {
        const std::uint32_t line = key.source().begin.line + piece.first_line - 1;
        const toml::array* decals = value.as_array();
        if (key.str() != "decal") {
            reader.complain_of_file(
                line, fmt::format("unknown key {}; a table of decals holds [[decal]] only", quote(key.str())));
        } else if (decals == nullptr || !std::ranges::all_of(*decals, &toml::node::is_table)) {
            reader.complain_of_file(line, "\"decal\" must be an array of tables: [[decal]]");
        } else {
            for (const toml::node& decal : *decals) rows.read(*decal.as_table(), piece.first_line);
        }
    }
    if (piece.is_all && !table.contains("decal"))
        reader.complain_of_file(0, "holds no [[decal]], which needs at least center = [x, y, z]");
}

std::string toml_value(const DecalColumn& column, const Projector& row) {
    std::string text = column.write(row);
    if (text.empty() || column.field == Field::number) return text;
    std::ostringstream out;
    if (column.field == Field::truth)
        out << (text == "yes" ? "true" : "false");
    else
        out << toml::value<std::string>(std::move(text));
    return out.str();
}

}  // namespace

bool is_toml(const std::filesystem::path& file) { return lower(file.extension().string()) == ".toml"; }

std::vector<Projector> load_decal_toml(const std::filesystem::path& file, std::size_t textures) {
    const std::string text = read_text(file, "a table of decals", kAnyLength), name = file.string();
    DecalReader reader(name, textures, DecalReader::Form::toml);
    const std::vector<Piece> pieces = pieces_of(text);
    std::vector<std::vector<Projector>> sound(pieces.size());  // rows of pieces without mistakes
    OIIO::parallel_for(std::uint64_t{0}, std::uint64_t{pieces.size()}, [&](std::uint64_t i) {
        DecalReader alone(name, textures, DecalReader::Form::toml);
        try {
            read_piece(alone, name, pieces[i]);
            sound[i] = alone.finish();
        } catch (...) {  // read again below: messages count the decals before, which this piece does not know
        }
    });
    for (std::size_t i = 0; i < pieces.size(); ++i)
        if (sound[i].empty())
            read_piece(reader, name, pieces[i]);
        else
            reader.append(std::exchange(sound[i], {}));
    return reader.finish();
}

std::string decal_toml(std::span<const DecalColumn* const> columns, const std::vector<Projector>& rows) {
    const std::map<std::string_view, Columns> keys = columns_by_key();
    std::string text;
    for (const Projector& row : rows) {
        text += text.empty() ? "[[decal]]\n" : "\n[[decal]]\n";
        std::string_view last;
        for (const DecalColumn* column : columns) {
            if (column->key == last) continue;
            last = column->key;
            std::vector<std::string> values;
            for (const DecalColumn& each : keys.at(last)) values.push_back(toml_value(each, row));
            if (column->size > 0)
                text += fmt::format("{} = [{}]\n", last, fmt::join(values, ", "));
            else if (!values.front().empty())
                text += fmt::format("{} = {}\n", last, values.front());
        }
    }
    return text.empty() ? "decal = []\n" : text;
}

}  // namespace wrinkle::scene
