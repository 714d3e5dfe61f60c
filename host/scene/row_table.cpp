#include "scene/row_table.h"

#include <fmt/format.h>

#include <string_view>

#include "base/only_errors.h"
#include "base/text_file.h"
#include "io/csv_rows.h"
#include "io/csv_table.h"
#include "io/npy_records.h"
#include "scene/row_claim.h"
#include "scene/row_reader.h"
#include "scene/row_toml.h"
#include "wrinkle/decal_layers.h"
#include "wrinkle/error.h"
#include "wrinkle/lighting.h"

namespace wrinkle::scene {
namespace {

/// The most rows that a CSV text can hold: its lines, whatever ends them, but for those that are empty or a comment.
std::size_t rows_of_csv(std::string_view text) {
    std::size_t rows = 0;
    for (std::size_t at = 0; at < text.size();) {
        rows += std::string_view("\r\n#").find(text[at]) == std::string_view::npos ? 1 : 0;
        const std::size_t end = text.find_first_of("\r\n", at);
        at = end == std::string_view::npos ? text.size() : end + 1;
    }
    return rows;
}

template <class Row>
std::vector<Row> load_csv(const std::filesystem::path& file, const RowKind<Row>& kind) {
    RowReader<Row> reader(file.string(), kind, TableForm::csv);
    const auto take = [&](std::uint32_t line, std::span<const std::string_view> cells) {
        const std::vector<const Column<Row>*>& columns = reader.header();
        if (columns.empty()) {
            reader.read_header(std::vector<std::string>(cells.begin(), cells.end()), line);
        } else if (cells.size() != columns.size()) {
            reader.complain(line,
                            fmt::format("has {} fields; the header names {} columns", cells.size(), columns.size()));
        } else {
            reader.begin_row(line);
            for (std::size_t i = 0; i < cells.size(); ++i)
                if (columns[i] != nullptr) reader.read_text(*columns[i], cells[i]);
            reader.end_row();
        }
    };
    const std::string text = read_text(file, fmt::format("a table of {}s", kind.name), kAnyLength);
    check_rows(file, claim_of(kind), rows_of_csv(text), text.size());
    io::read_csv_rows(text, file.string(), io::CsvComments::lines, take);
    if (reader.header().empty())
        reader.complain_of_file(0, "holds no table; its first line names the columns, at least x,y,z");
    return reader.finish();
}

template <class Row>
std::vector<Row> load_npy(const std::filesystem::path& file, const RowKind<Row>& kind) {
    const io::NpyRecords records(file);
    check_rows(file, claim_of(kind), records.rows(), records.file_bytes());
    RowReader<Row> reader(file.string(), kind, TableForm::npy);
    std::vector<std::string> names;
    for (const io::NpyRecords::Field& field : records.fields()) names.push_back(field.name);
    reader.read_header(names, 0);
    for (std::size_t row = 0; row < records.rows(); ++row) {
        reader.begin_row(0);
        for (std::size_t i = 0; i < names.size(); ++i) {
            const Column<Row>* column = reader.header()[i];
            const io::NpyRecords::Field& field = records.fields()[i];
            if (column == nullptr) continue;
            if (field.is_text())
                reader.read_text(*column, records.text(row, field));
            else
                reader.read_number(*column, records.number(row, field));
        }
        reader.end_row();
    }
    return reader.finish();
}

}  // namespace

template <class Row>
std::vector<Row> load_rows(const std::filesystem::path& file, const RowKind<Row>& kind) {
    return only_errors(file.c_str(), [&] {
        if (is_toml(file)) return load_row_toml(file, kind);
        return io::NpyRecords::is(file) ? load_npy(file, kind) : load_csv(file, kind);
    });
}

template <class Row>
std::string row_csv(std::span<const Column<Row>* const> columns, const std::vector<Row>& rows) {
    std::string text;
    for (const Column<Row>* column : columns) {
        if (column != columns.front()) text += ',';
        text += column->name;
    }
    for (const Row& row : rows) {
        text += '\n';
        for (const Column<Row>* column : columns) {
            if (column != columns.front()) text += ',';
            io::append_csv_cell(text, column->write(row));
        }
    }
    return text + '\n';
}

template std::vector<Projector> load_rows(const std::filesystem::path&, const RowKind<Projector>&);
template std::vector<Light> load_rows(const std::filesystem::path&, const RowKind<Light>&);
template std::string row_csv(std::span<const Column<Projector>* const>, const std::vector<Projector>&);

}  // namespace wrinkle::scene
