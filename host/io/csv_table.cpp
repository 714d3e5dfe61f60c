#include "io/csv_table.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/only_errors.h"
#include "io/csv_rows.h"
#include "wrinkle/error.h"

namespace wrinkle::io {

namespace {

/// A cell as messages show it: on one line, and not too long.
std::string shown(std::string_view cell) {
    std::string out;
    for (const char c : cell.substr(0, 40)) out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
    return out + (cell.size() > 40 ? "..." : "");
}

/// False when `text` is no number, or one beyond the range of T.
template <class T>
bool parse(std::string_view text, T& value) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (stop != end || text.empty()) return false;
    if (error != std::errc::result_out_of_range) return error == std::errc();
    const std::string copy(text);  // from_chars also refuses numbers that are too small; strtod rounds them to 0
    if constexpr (std::is_same_v<T, float>)
        value = std::strtof(copy.c_str(), nullptr);
    else
        value = std::strtod(copy.c_str(), nullptr);
    return std::isfinite(value);
}

}  // namespace

CsvTable::CsvTable(std::string_view text, std::string name) : name_(std::move(name)) {
    only_errors(name_.c_str(), [&] { read(text); });
}

void CsvTable::read(std::string_view text) {
    text_.reserve(text.size());
    read_csv_rows(text, name_, CsvComments::none, [this](std::uint32_t line, std::span<const std::string_view> cells) {
        if (names_.empty()) {
            names_.assign(cells.begin(), cells.end());
            return;
        }
        lines_.push_back(line);
        if (cells.size() != names_.size())
            throw Error(fmt::format("{}:{}: row {} has {} cell{}, the header {} column{}", name_, line, lines_.size(),
                                    cells.size(), cells.size() == 1 ? "" : "s", names_.size(),
                                    names_.size() == 1 ? "" : "s"));
        for (const std::string_view cell : cells) {
            text_ += cell;
            ends_.push_back(text_.size());
        }
    });
    if (names_.empty()) throw Error(fmt::format("{} is empty; its first row must name the columns", name_));
}

std::string_view CsvTable::cell(std::size_t row, std::size_t column) const {
    const std::size_t at = row * names_.size() + column, begin = at == 0 ? 0 : ends_[at - 1];
    return std::string_view(text_).substr(begin, ends_[at] - begin);
}

template <class T>
std::vector<T> CsvTable::numbers(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) throw Error(fmt::format("{} has no column \"{}\"", name_, name));
    if (std::find(found + 1, names_.end(), name) != names_.end())
        throw Error(fmt::format("{} has two columns \"{}\"", name_, name));
    const auto column = static_cast<std::size_t>(found - names_.begin());
    std::vector<T> out(rows());
    for (std::size_t row = 0; row < rows(); ++row) {
        const std::string_view text = cell(row, column);
        if (parse(text, out[row])) continue;
        const std::string where = fmt::format("{}:{}: row {}, column \"{}\"", name_, lines_[row], row + 1, name);
        if (text.empty()) throw Error(where + " is empty");
        double as_double = 0;
        throw Error(
            fmt::format("{}: \"{}\" is {}", where, shown(text),
                        parse(text, as_double) ? "too large for a float; use --precision double" : "no number"));
    }
    return out;
}

template std::vector<float> CsvTable::numbers(const std::string&) const;
template std::vector<double> CsvTable::numbers(const std::string&) const;

void append_csv_cell(std::string& to, std::string_view cell) {
    const bool blank_edge =
        !cell.empty() && (cell.front() == ' ' || cell.back() == ' ' || cell.front() == '\t' || cell.back() == '\t');
    if (!blank_edge && cell.find_first_of(",\"\r\n") == std::string_view::npos) {
        to += cell;
        return;
    }
    const std::size_t before = to.size();
    to.resize(before + csv_write(nullptr, 0, cell.data(), cell.size()));
    csv_write(to.data() + before, to.size() - before, cell.data(), cell.size());
}

template <class T>
void append_number(std::string& to, T value) {
    std::array<char, 32> digits;
    to.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

template void append_number(std::string&, float);
template void append_number(std::string&, double);

}  // namespace wrinkle::io
