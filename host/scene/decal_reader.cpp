#include "scene/decal_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "scene/vec.h"

namespace wrinkle::scene {

namespace {

constexpr std::size_t kMostProblems = 20;
constexpr std::size_t kRequired = 3;  // columns, the first ones

}  // namespace

void DecalReader::complain(std::uint32_t place, std::string text) {
    last_ = place;
    if (count_++ >= kMostProblems) return;
    if (places_ == Places::lines)
        problems_.add(place, std::move(text));
    else
        problems_.add(0, fmt::format("row {}: {}", place, text));
}

void DecalReader::read_header(const std::vector<std::string>& names, std::uint32_t place) {
    std::vector<std::string> known;
    for (const DecalColumn& column : decal_columns()) known.emplace_back(column.name);
    const auto complain_of_header = [&](std::string text) {
        if (count_++ < kMostProblems) problems_.add(place, std::move(text));
    };
    for (const std::string& name : names) {
        const auto found = std::ranges::find(known, name);
        const DecalColumn* column =
            found == known.end() ? nullptr : &decal_columns()[static_cast<std::size_t>(found - known.begin())];
        if (!column)
            complain_of_header(fmt::format("unknown column {}{}", quote(name),
                                           did_you_mean(name, known).empty()
                                               ? fmt::format("; known columns: {}", fmt::join(known, ", "))
                                               : did_you_mean(name, known)));
        else if (std::ranges::find(header_, column) != header_.end())
            complain_of_header(fmt::format("the column {} is there twice", quote(name)));
        header_.push_back(column);
    }
    for (const DecalColumn& column : decal_columns().first(kRequired))
        if (std::ranges::find(header_, &column) == header_.end())
            complain_of_header(fmt::format("the column {} is missing", quote(column.name)));
}

void DecalReader::begin_row(std::uint32_t place) {
    place_ = place;
    rows_.emplace_back();
}

void DecalReader::complain_of(const DecalColumn& column, const std::string& found, const std::string& wrong) {
    complain(place_, fmt::format("column {} is {}; it {}", quote(column.name), found, wrong));
}

void DecalReader::read_text(std::size_t column, std::string_view field) {
    const DecalColumn* known = header_[column];
    if (!known) return;
    if (field.empty()) {
        if (known < decal_columns().data() + kRequired)
            complain(place_, fmt::format("column {} is empty", quote(known->name)));
        return;
    }
    if (const std::string wrong = known->read(field, rows_.back()); !wrong.empty())
        complain_of(*known, quote(field), wrong);
}

void DecalReader::read_number(std::size_t column, double value) {
    const DecalColumn* known = header_[column];
    if (!known) return;
    const std::string wrong =
        known->take ? known->take(value, rows_.back()) : std::string("holds text: a field of kind S or U");
    if (!wrong.empty()) complain_of(*known, fmt::format("{}", value), wrong);
}

/// What single fields cannot show.
void DecalReader::end_row() {
    const Projector& row = rows_.back();
    if (row.texture >= textures_)
        complain(place_, fmt::format("column \"texture\" is {}; the layer has {} texture{}, counted from 0",
                                     row.texture, textures_, textures_ == 1 ? "" : "s"));
    if (row.region[0] >= row.region[2] || row.region[1] >= row.region[3])
        complain(place_, "columns \"s0\", \"t0\" must be below \"s1\", \"t1\"");
    if (row.angle_fade[0] > row.angle_fade[1])
        complain(place_, "column \"angle_full\" must not be above \"angle_zero\"");
    if (row.object && !row.cryptomatte.empty())
        complain(place_, "columns \"object\" and \"cryptomatte\" cannot both be given; leave one empty");
    if (parallel(row.axis_x, row.axis_y))
        complain(place_, "columns \"axis_x_...\" and \"axis_y_...\" must not be parallel, nor zero");
}

std::vector<Projector> DecalReader::finish() {
    if (count_ > kMostProblems) {
        const std::size_t more = count_ - kMostProblems;
        problems_.add(places_ == Places::lines ? last_ : 0,
                      fmt::format("{}and {} more mistakes",
                                  places_ == Places::lines ? "" : fmt::format("row {}: ", last_), more));
    }
    problems_.throw_if_any();
    return std::move(rows_);
}

}  // namespace wrinkle::scene
