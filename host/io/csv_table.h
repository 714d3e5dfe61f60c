#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wrinkle::io {

/// The cells of a CSV file as text, in the dialects that csv_rows.h knows. The first row names the columns.
class CsvTable {
public:
    /// Throws Error when the text is empty, a row has more or fewer cells than the header, or read_csv_rows does.
    /// `name` is for messages.
    CsvTable(std::string_view text, std::string name);

    const std::vector<std::string>& names() const { return names_; }
    std::size_t rows() const { return lines_.size(); }
    std::string_view cell(std::size_t row, std::size_t column) const;

    /// The numbers of the column `name`, each rounded once. T is float or double. Throws Error naming row, line and
    /// column of a cell that holds no number, or when there is no such column or two of it.
    template <class T>
    std::vector<T> numbers(const std::string& name) const;

private:
    std::string name_, text_;  ///< all cells, one after another
    std::vector<std::string> names_;
    std::vector<std::size_t> ends_;     ///< in text_, of each cell
    std::vector<std::uint32_t> lines_;  ///< of each row
};

/// Appends a cell, quoted where it must be.
void append_csv_cell(std::string& to, std::string_view cell);

/// Appends the shortest text that reads back as the same number. T is float or double.
template <class T>
void append_number(std::string& to, T value);

}  // namespace wrinkle::io
