#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/problems.h"
#include "scene/row_kind.h"

namespace wrinkle::scene {

/// What a table is written in; memory: it is not written, rows were made in code.
enum class TableForm { csv, npy, toml, memory };

/// The rows of a table while they are read, or checked, and what is wrong with them: the first mistakes in
/// full, the rest as a number. Mistakes are told in the words of the table's form.
template <class Row>
class RowReader {
public:
    /// `file` as messages show it. `kind` has to outlive the reader.
    RowReader(const std::string& file, const RowKind<Row>& kind, TableForm form)
        : problems_(file), kind_(kind), form_(form) {}

    /// About the row being read; `line` is 0 where the form has no lines.
    void complain(std::uint32_t line, std::string text);
    /// About the file as a whole.
    void complain_of_file(std::uint32_t line, std::string text);

    /// Takes the names of the columns, in the order of the fields. In header() a column that is not known is null.
    void read_header(std::span<const std::string> names, std::uint32_t line);
    const std::vector<const Column<Row>*>& header() const { return header_; }

    /// For every row: begin_row(), one call for each field, end_row().
    void begin_row(std::uint32_t line);
    /// The fields that follow are in this line.
    void go_to(std::uint32_t line) { line_ = line; }
    /// An empty field leaves the default.
    void read_text(const Column<Row>& column, std::string_view field);
    void read_number(const Column<Row>& column, double value);
    /// Notes that a field has a type that the column cannot take.
    void refuse(const Column<Row>& column, const std::string& found, const std::string& wrong);
    void end_row() { check_together(rows_.back(), row_line_); }
    /// Checks a row that was made in code.
    void check(const Row& row);
    /// Rows that another reader finished.
    void append(std::vector<Row> rows);

    /// Throws Error if anything was wrong.
    std::vector<Row> finish();

private:
    std::size_t begun() const { return rows_.size() + checked_; }
    bool by_key() const { return form_ == TableForm::toml || form_ == TableForm::memory; }
    void check_together(const Row& row, std::uint32_t line);
    std::string named(const Column<Row>& column) const;
    bool is_required(const Column<Row>& column) const { return &column < kind_.columns.data() + kind_.required; }
    std::string listed(std::initializer_list<const char*> columns) const;

    Problems problems_;
    const RowKind<Row>& kind_;
    std::size_t count_ = 0, checked_ = 0;
    TableForm form_;
    std::uint32_t line_ = 0, row_line_ = 0,
                  last_line_ = 0;  ///< of the field being read, of its row; of the last mistake
    std::size_t last_row_ = 0;
    std::vector<const Column<Row>*> header_;
    std::vector<Row> rows_;
};

}  // namespace wrinkle::scene
