#include "scene/decal_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "base/names.h"
#include "base/vec.h"

namespace wrinkle::scene {

namespace {

constexpr std::size_t kMostProblems = 20;

/// How messages about a row begin; it is the last of `rows` that were begun.
std::string row_prefix(DecalReader::Form form, std::size_t rows) {
    if (form == DecalReader::Form::npy || form == DecalReader::Form::memory) return fmt::format("row {}: ", rows - 1);
    return form == DecalReader::Form::toml ? fmt::format("[[decal]] {}: ", rows) : std::string{};
}

}  // namespace

void DecalReader::complain(std::uint32_t line, std::string text) {
    last_line_ = line, last_row_ = begun();
    if (count_++ < kMostProblems) problems_.add(line, row_prefix(form_, last_row_) + text);
}

void DecalReader::complain_of_file(std::uint32_t line, std::string text) {
    last_line_ = line, last_row_ = begun();
    if (count_++ < kMostProblems) problems_.add(line, std::move(text));
}

void DecalReader::read_header(std::span<const std::string> names, std::uint32_t line) {
    std::vector<std::string> known;
    for (const DecalColumn& column : decal_columns()) known.emplace_back(column.name);
    for (const std::string& name : names) {
        const auto found = std::ranges::find(known, name);
        const DecalColumn* column =
            found == known.end() ? nullptr : &decal_columns()[static_cast<std::size_t>(found - known.begin())];
        if (!column)
            complain_of_file(line, fmt::format("unknown column {}{}", quote(name),
                                               did_you_mean(name, known).empty()
                                                   ? fmt::format("; known columns: {}", fmt::join(known, ", "))
                                                   : did_you_mean(name, known)));
        else if (std::ranges::find(header_, column) != header_.end())
            complain_of_file(line, fmt::format("the column {} is there twice", quote(name)));
        header_.push_back(column);
    }
    for (const DecalColumn& column : decal_columns().first(kRequiredColumns))
        if (std::ranges::find(header_, &column) == header_.end())
            complain_of_file(line, fmt::format("the column {} is missing", quote(column.name)));
}

void DecalReader::begin_row(std::uint32_t line) {
    line_ = line;
    rows_.emplace_back().line = line;
}

std::string DecalReader::named(const DecalColumn& column) const {
    if (!by_key()) return "column " + quote(column.name);
    if (column.size == 0) return quote(column.key);
    const DecalColumn* first = &column;
    while (first != decal_columns().data() && std::string_view((first - 1)->key) == column.key) --first;
    return fmt::format("element {} of {}", &column - first + 1, quote(column.key));
}

std::string DecalReader::listed(std::initializer_list<const char*> columns) const {
    std::vector<std::string> names;
    for (const char* name : columns) {
        const auto column = std::ranges::find(decal_columns(), std::string_view(name), &DecalColumn::name);
        const std::string shown = quote(by_key() ? column->key : column->name);
        if (std::ranges::find(names, shown) == names.end()) names.push_back(shown);
    }
    return fmt::format("{}{}", by_key() ? "" : "columns ", fmt::join(names, ", "));
}

void DecalReader::refuse(const DecalColumn& column, const std::string& found, const std::string& wrong) {
    complain(line_, fmt::format("{} is {}; it {}", named(column), found, wrong));
}

void DecalReader::read_text(const DecalColumn& column, std::string_view field) {
    if (field.empty()) {
        if (&column < decal_columns().data() + kRequiredColumns)
            complain(line_, fmt::format("{} is empty", named(column)));
        return;
    }
    if (const std::string wrong = column.read(field, rows_.back()); !wrong.empty()) refuse(column, quote(field), wrong);
}

void DecalReader::read_number(const DecalColumn& column, double value) {
    const std::string wrong =
        column.take ? column.take(value, rows_.back()) : std::string("holds text: a field of kind S or U");
    if (!wrong.empty()) refuse(column, fmt::format("{}", value), wrong);
}

/// What single fields cannot show.
void DecalReader::check_together(const Projector& row, std::uint32_t line) {
    const auto wrong = [&](std::initializer_list<const char*> columns, const char* text) {
        complain(line, fmt::format("{} {}", listed(columns), text));
    };
    if (row.texture >= textures_)
        complain(line, fmt::format("{}\"texture\" is {}; the layer has {} texture{}, counted from 0",
                                   by_key() ? "" : "column ", row.texture, textures_, textures_ == 1 ? "" : "s"));
    if (row.region[0] >= row.region[2] || row.region[1] >= row.region[3])
        wrong({"s0", "t0", "s1", "t1"}, "must have s0 below s1, and t0 below t1");
    if (row.angle_fade[0] > row.angle_fade[1])
        wrong({"angle_full", "angle_zero"}, "must be the angle that gets all, then a larger one that gets nothing");
    if (row.object && !row.cryptomatte.empty())
        wrong({"object", "cryptomatte"}, "cannot both be given; leave one empty");
    if (parallel(row.axis_x, row.axis_y))
        wrong({"axis_x_x", "axis_x_y", "axis_x_z", "axis_y_x", "axis_y_y", "axis_y_z"},
              "must be two axes, not parallel, nor zero");
}

void DecalReader::check(const Projector& row) {
    ++checked_;
    const std::size_t before = count_;
    for (const DecalColumn& column : decal_columns())
        if (const std::string wrong = column.wrong(row); !wrong.empty())
            complain(0, fmt::format("{} {}", named(column), wrong));
    if (count_ == before) check_together(row, 0);
}

void DecalReader::append(std::vector<Projector> rows) {
    rows_.insert(rows_.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
}

std::vector<Projector> DecalReader::finish() {
    if (count_ > kMostProblems)
        problems_.add(last_line_,
                      fmt::format("{}and {} more mistakes", last_row_ > 0 ? row_prefix(form_, last_row_) : "",
                                  count_ - kMostProblems));
    problems_.throw_if_any();
    return std::move(rows_);
}

}  // namespace wrinkle::scene
