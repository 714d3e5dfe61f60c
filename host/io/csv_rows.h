#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace wrinkle::io {

/// Takes a row: the line it begins in, and its cells as text, which last as long as the call.
using CsvRowTaker = std::function<void(std::uint32_t line, std::span<const std::string_view> cells)>;

enum class CsvComments { none, lines };  ///< lines: what begins with # is skipped

/// Gives every row of CSV to `take`: RFC 4180; any line ends, a byte order mark, quoted cells, blanks around cells.
/// Lines without a cell are skipped. `name` is for messages. Throws Error with the line where a quote is out of place,
/// or columns are separated by semicolons or tabs; and what `take` throws.
void read_csv_rows(std::string_view text, const std::string& name, CsvComments comments, const CsvRowTaker& take);

}  // namespace wrinkle::io
