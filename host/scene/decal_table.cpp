#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include "io/atomic_file.h"
#include "scene/decal_columns.h"
#include "scene/files.h"
#include "scene/problems.h"
#include "scene/vec.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace scene {
namespace {

constexpr std::size_t kMostProblems = 20;

/// Mistakes of a table: the first ones in full, the rest as a number.
class TableProblems {
public:
    explicit TableProblems(const std::string& file) : problems_(file) {}
    void add(std::uint32_t line, std::string text) {
        if (count_++ < kMostProblems) problems_.add(line, std::move(text));
        last_ = line;
    }
    void throw_if_any() {
        if (count_ > kMostProblems) problems_.add(last_, fmt::format("and {} more mistakes", count_ - kMostProblems));
        problems_.throw_if_any();
    }

private:
    Problems problems_;
    std::size_t count_ = 0;
    std::uint32_t last_ = 0;
};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r"), last = text.find_last_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view{} : text.substr(first, last - first + 1);
}

/// Takes what stands before the next `mark`.
std::string_view take(std::string_view& rest, char mark) {
    const std::size_t end = rest.find(mark);
    const std::string_view part = rest.substr(0, end);
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    return part;
}

std::vector<const DecalColumn*> read_header(std::string_view line, std::uint32_t number, TableProblems& problems) {
    std::vector<std::string> known;
    for (const DecalColumn& column : decal_columns()) known.emplace_back(column.name);
    std::vector<const DecalColumn*> header;
    for (bool more = true; more;) {
        more = line.find(',') != std::string_view::npos;
        const std::string_view name = trimmed(take(line, ','));
        const auto found = std::ranges::find(known, name);
        const DecalColumn* column =
            found == known.end() ? nullptr : &decal_columns()[static_cast<std::size_t>(found - known.begin())];
        if (!column)
            problems.add(number, fmt::format("unknown column {}{}", quote(name),
                                             did_you_mean(name, known).empty()
                                                 ? fmt::format("; known columns: {}", fmt::join(known, ", "))
                                                 : did_you_mean(name, known)));
        else if (std::ranges::find(header, column) != header.end())
            problems.add(number, fmt::format("the column {} is there twice", quote(name)));
        header.push_back(column);
    }
    for (const DecalColumn& column : decal_columns().first(3))
        if (std::ranges::find(header, &column) == header.end())
            problems.add(number, fmt::format("the column {} is missing", quote(column.name)));
    return header;
}

/// What single fields cannot show.
void check_row(const Projector& row, std::size_t textures, std::uint32_t line, TableProblems& problems) {
    if (row.texture >= textures)
        problems.add(line, fmt::format("column \"texture\" is {}; the layer has {} texture{}, counted from 0",
                                       row.texture, textures, textures == 1 ? "" : "s"));
    if (row.region[0] >= row.region[2] || row.region[1] >= row.region[3])
        problems.add(line, "columns \"s0\", \"t0\" must be below \"s1\", \"t1\"");
    if (row.angle_fade[0] > row.angle_fade[1])
        problems.add(line, "column \"angle_full\" must not be above \"angle_zero\"");
    if (parallel(row.axis_x, row.axis_y))
        problems.add(line, "columns \"axis_x_...\" and \"axis_y_...\" must not be parallel, nor zero");
}

}  // namespace
}  // namespace scene

std::vector<Projector> load_decals(const std::filesystem::path& file, std::size_t textures) {
    using namespace scene;
    const std::string text = read_text(file), name = file.filename().string();
    TableProblems problems(name);
    std::vector<const DecalColumn*> header;
    std::vector<Projector> rows;
    rows.reserve(static_cast<std::size_t>(std::ranges::count(text, '\n')));
    std::string_view rest = text;
    for (std::uint32_t number = 1; !rest.empty(); ++number) {
        std::string_view line = take(rest, '\n');
        if (const std::string_view content = trimmed(line); content.empty() || content.front() == '#') continue;
        if (header.empty()) {
            header = read_header(line, number, problems);
            continue;
        }
        const auto fields = static_cast<std::size_t>(std::ranges::count(line, ',')) + 1;
        if (fields != header.size()) {
            problems.add(number, fmt::format("has {} fields; the header names {} columns", fields, header.size()));
            continue;
        }
        Projector& row = rows.emplace_back();
        for (std::size_t column = 0; column < header.size(); ++column) {
            const std::string_view field = trimmed(take(line, ','));
            if (!header[column]) continue;
            if (field.empty()) {
                if (header[column] - decal_columns().data() < 3)
                    problems.add(number, fmt::format("column {} is empty", quote(header[column]->name)));
                continue;
            }
            if (const std::string wrong = header[column]->read(field, row); !wrong.empty())
                problems.add(number,
                             fmt::format("column {} is {}; it {}", quote(header[column]->name), quote(field), wrong));
        }
        check_row(row, textures, number, problems);
    }
    if (header.empty()) problems.add(0, "holds no table; its first line names the columns, at least x,y,z");
    problems.throw_if_any();
    return rows;
}

void save_decals(const std::filesystem::path& file, const std::vector<Projector>& rows) {
    using namespace scene;
    // Columns that every row leaves at its default are left out.
    std::vector<const DecalColumn*> used;
    const Projector standard;
    for (const DecalColumn& column : decal_columns()) {
        const bool differs = std::ranges::any_of(
            rows, [&, usual = column.write(standard)](const Projector& row) { return column.write(row) != usual; });
        if (differs || &column - decal_columns().data() < 3) used.push_back(&column);
    }
    std::string text;
    for (const DecalColumn* column : used) text += (column == used.front() ? "" : ",") + std::string(column->name);
    for (const Projector& row : rows) {
        text += '\n';
        for (const DecalColumn* column : used) text += (column == used.front() ? "" : ",") + column->write(row);
    }
    io::AtomicFile out(file);
    out.write(text + '\n');
    out.commit();
}

}  // namespace wrinkle
