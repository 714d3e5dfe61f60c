#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace wrinkle::io {

/// Is given a row: the line that it begins in, and the text of its cells, which is valid during the call only.
using CsvRowTaker = std::function<void(std::uint32_t line, std::span<const std::string_view> cells)>;

enum class CsvComments { none, lines };  ///< lines: those that begin with # are skipped

/// Calls `take` with every row of a CSV text (RFC 4180). Line ends may be of any kind; a byte order mark, quoted cells
/// and blanks around cells are understood; lines without a cell are skipped. `name` is for messages. Throws Error, with
/// the line, when a quote is out of place or columns are separated by semicolons or tabs. Lets pass what `take` throws.
void read_csv_rows(std::string_view text, const std::string& name, CsvComments comments, const CsvRowTaker& take);

}  // namespace wrinkle::io
