#include "scene/row_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "base/names.h"
#include "wrinkle/decal_layers.h"
#include "wrinkle/lighting.h"

namespace wrinkle::scene {

namespace {

constexpr std::size_t kMostProblems = 20;

/// How messages about a row begin; it is the last of `rows` that were begun.
std::string row_prefix(TableForm form, const char* name, std::size_t rows) {
    if (form == TableForm::npy || form == TableForm::memory) return fmt::format("row {}: ", rows - 1);
    return form == TableForm::toml ? fmt::format("[[{}]] {}: ", name, rows) : std::string{};
}

}  // namespace

template <class Row>
void RowReader<Row>::complain(std::uint32_t line, std::string text) {
    last_line_ = line, last_row_ = begun();
    if (count_++ < kMostProblems) problems_.add(line, row_prefix(form_, kind_.name, last_row_) + text);
}

template <class Row>
void RowReader<Row>::complain_of_file(std::uint32_t line, std::string text) {
    last_line_ = line, last_row_ = begun();
    if (count_++ < kMostProblems) problems_.add(line, std::move(text));
}

template <class Row>
void RowReader<Row>::read_header(std::span<const std::string> names, std::uint32_t line) {
    std::vector<std::string> known;
    for (const Column<Row>& column : kind_.columns) known.emplace_back(column.name);
    for (const std::string& name : names) {
        const auto found = std::ranges::find(known, name);
        const Column<Row>* column =
            found == known.end() ? nullptr : &kind_.columns[static_cast<std::size_t>(found - known.begin())];
        if (!column)
            complain_of_file(line, fmt::format("unknown column {}{}", quote(name),
                                               did_you_mean(name, known).empty()
                                                   ? fmt::format("; known columns: {}", fmt::join(known, ", "))
                                                   : did_you_mean(name, known)));
        else if (std::ranges::find(header_, column) != header_.end())
            complain_of_file(line, fmt::format("the column {} is there twice", quote(name)));
        header_.push_back(column);
    }
    for (const Column<Row>& column : kind_.columns.first(kind_.required))
        if (std::ranges::find(header_, &column) == header_.end())
            complain_of_file(line, fmt::format("the column {} is missing", quote(column.name)));
}

template <class Row>
void RowReader<Row>::begin_row(std::uint32_t line) {
    line_ = row_line_ = line;
    Row& row = rows_.emplace_back();
    if (kind_.begin) kind_.begin(row, line);
}

template <class Row>
std::string RowReader<Row>::named(const Column<Row>& column) const {
    if (!by_key()) return "column " + quote(column.name);
    if (column.size == 0) return quote(column.key);
    const Column<Row>* first = &column;
    while (first != kind_.columns.data() && std::string_view((first - 1)->key) == column.key) --first;
    return fmt::format("element {} of {}", &column - first + 1, quote(column.key));
}

template <class Row>
std::string RowReader<Row>::listed(std::initializer_list<const char*> columns) const {
    std::vector<std::string> names;
    for (const char* name : columns) {
        const auto column = std::ranges::find(kind_.columns, std::string_view(name), &Column<Row>::name);
        const std::string shown = quote(by_key() ? column->key : column->name);
        if (std::ranges::find(names, shown) == names.end()) names.push_back(shown);
    }
    return fmt::format("{}{}", by_key() ? "" : names.size() == 1 ? "column " : "columns ", fmt::join(names, ", "));
}

template <class Row>
void RowReader<Row>::refuse(const Column<Row>& column, const std::string& found, const std::string& wrong) {
    complain(line_, fmt::format("{} is {}; it {}", named(column), found, wrong));
}

template <class Row>
void RowReader<Row>::read_text(const Column<Row>& column, std::string_view field) {
    if (field.empty()) {
        if (is_required(column)) complain(line_, fmt::format("{} is empty", named(column)));
        return;
    }
    if (const std::string wrong = column.read(field, rows_.back()); !wrong.empty()) refuse(column, quote(field), wrong);
}

template <class Row>
void RowReader<Row>::read_number(const Column<Row>& column, double value) {
    const std::string wrong =
        column.take ? column.take(value, rows_.back()) : std::string("holds text: a field of kind S or U");
    if (!wrong.empty()) refuse(column, fmt::format("{}", value), wrong);
}

template <class Row>
void RowReader<Row>::check_together(const Row& row, std::uint32_t line) {
    kind_.together(row, [&](std::initializer_list<const char*> columns, const std::string& text) {
        complain(line, columns.size() > 0 ? fmt::format("{} {}", listed(columns), text) : text);
    });
}

template <class Row>
void RowReader<Row>::check(const Row& row) {
    ++checked_;
    const std::size_t before = count_;
    for (const Column<Row>& column : kind_.columns)
        if (const std::string wrong = column.wrong(row); !wrong.empty())
            complain(0, fmt::format("{} {}", named(column), wrong));
    if (count_ == before) check_together(row, 0);
}

template <class Row>
void RowReader<Row>::append(std::vector<Row> rows) {
    rows_.insert(rows_.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
}

template <class Row>
std::vector<Row> RowReader<Row>::finish() {
    if (count_ > kMostProblems)
        problems_.add(last_line_, fmt::format("{}and {} more mistakes",
                                              last_row_ > 0 ? row_prefix(form_, kind_.name, last_row_) : "",
                                              count_ - kMostProblems));
    problems_.throw_if_any();
    return std::move(rows_);
}

template class RowReader<Projector>;
template class RowReader<Light>;

}  // namespace wrinkle::scene
