#include <fmt/format.h>

#include <algorithm>

#include "io/atomic_file.h"
#include "io/npy_records.h"
#include "scene/decal_reader.h"
#include "scene/files.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace scene {
namespace {

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

std::size_t fields_of(std::string_view line) { return static_cast<std::size_t>(std::ranges::count(line, ',')) + 1; }

std::vector<Projector> load_csv(const std::filesystem::path& file, std::size_t textures) {
    const std::string text = read_text(file);
    DecalReader reader(file.filename().string(), textures, DecalReader::Places::lines);
    std::string_view rest = text;
    for (std::uint32_t number = 1; !rest.empty(); ++number) {
        std::string_view line = take(rest, '\n');
        if (const std::string_view content = trimmed(line); content.empty() || content.front() == '#') continue;
        const std::size_t fields = fields_of(line), columns = reader.header().size();
        if (columns == 0) {
            std::vector<std::string> names;
            for (std::size_t i = 0; i < fields; ++i) names.emplace_back(trimmed(take(line, ',')));
            reader.read_header(names, number);
            continue;
        }
        if (fields != columns) {
            reader.complain(number, fmt::format("has {} fields; the header names {} columns", fields, columns));
            continue;
        }
        reader.begin_row(number);
        for (std::size_t column = 0; column < columns; ++column) reader.read_text(column, trimmed(take(line, ',')));
        reader.end_row();
    }
    if (reader.header().empty()) reader.complain(0, "holds no table; its first line names the columns, at least x,y,z");
    return reader.finish();
}

std::vector<Projector> load_npy(const std::filesystem::path& file, std::size_t textures) {
    const io::NpyRecords records(file);
    DecalReader reader(file.filename().string(), textures, DecalReader::Places::rows);
    std::vector<std::string> names;
    for (const io::NpyRecords::Field& field : records.fields()) names.push_back(field.name);
    reader.read_header(names, 0);
    for (std::size_t row = 0; row < records.rows(); ++row) {
        reader.begin_row(static_cast<std::uint32_t>(row));
        for (std::size_t column = 0; column < names.size(); ++column) {
            const io::NpyRecords::Field& field = records.fields()[column];
            if (field.is_text())
                reader.read_text(column, records.text(row, field));
            else
                reader.read_number(column, records.number(row, field));
        }
        reader.end_row();
    }
    return reader.finish();
}

}  // namespace
}  // namespace scene

std::vector<Projector> load_decals(const std::filesystem::path& file, std::size_t textures) {
    return io::NpyRecords::is(file) ? scene::load_npy(file, textures) : scene::load_csv(file, textures);
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
