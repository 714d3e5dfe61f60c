#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace wrinkle::io {

/// The cells of a CSV file as text, read by read_csv_rows(). The first row names the columns.
class CsvTable {
public:
    /// Throws Error when the text is empty, a row has more or fewer cells than the header, or read_csv_rows does.
    /// `name` is for messages.
    CsvTable(std::string_view text, std::string name);

    const std::vector<std::string>& names() const { return names_; }
    std::size_t rows() const { return lines_.size(); }
    std::string_view cell(std::size_t row, std::size_t column) const;

    /// The numbers of a column. T is float or double; text is rounded to T directly. Throws Error when no column or two
    /// columns have this name, and for a cell without a number, whose row, line and column it tells.
    template <class T>
    std::vector<T> numbers(const std::string& name) const;

private:
    void read(std::string_view text);

    std::string name_, text_;  ///< text_: all cells, one after another
    std::vector<std::string> names_;
    std::vector<std::size_t> ends_;     ///< where each cell ends in text_
    std::vector<std::uint32_t> lines_;  ///< the line that each row begins in
};

/// Appends a cell, quoted where it must be.
void append_csv_cell(std::string& to, std::string_view cell);

/// Appends the shortest text that reads back as the same number. T is float or double.
template <class T>
void append_number(std::string& to, T value);

}  // namespace wrinkle::io
