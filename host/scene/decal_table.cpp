#include <fmt/format.h>

#include <algorithm>

#include "base/atomic_file.h"
#include "base/claim.h"
#include "base/limits.h"
#include "base/only_errors.h"
#include "base/text_file.h"
#include "io/csv_rows.h"
#include "io/csv_table.h"
#include "io/npy_records.h"
#include "scene/decal_reader.h"
#include "scene/decal_toml.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace scene {
namespace {

/// Asks for the memory of all rows before the first of them takes any. Rows of a few bytes each become far more memory
/// than their file is long; beyond what tables of real decals come to, somebody has to have allowed it.
void check_rows(const std::filesystem::path& file, std::size_t rows, std::uint64_t file_bytes) {
    constexpr double kBytesARow = 1300;  // measured: a row, what kernels get of it, and the bins that it lies in
    constexpr double kUnasked = 256e6, kRowOverText = 32;
    const double wanted = kBytesARow * static_cast<double>(rows);
    const std::string what = fmt::format("a table of {} decals", rows);
    check_memory(file.string(), wanted, what);
    const double table = sizeof(Projector) * static_cast<double>(rows), bytes = static_cast<double>(file_bytes);
    if (table > kUnasked + kRowOverText * bytes && !is_memory_set())
        throw Error(
            fmt::format("{}: {} in a file of {} would take {} of memory; if it is meant, allow that by "
                        "--memory or WRINKLE_MEMORY, in GB",
                        file.string(), what, bytes_text(bytes), bytes_text(wanted)));
}

std::vector<Projector> load_csv(const std::filesystem::path& file, std::size_t textures) {
    DecalReader reader(file.string(), textures, DecalReader::Form::csv);
    const auto take = [&](std::uint32_t line, std::span<const std::string_view> cells) {
        const std::vector<const DecalColumn*>& columns = reader.header();
        if (columns.empty()) {
            reader.read_header(std::vector<std::string>(cells.begin(), cells.end()), line);
        } else if (cells.size() != columns.size()) {
            reader.complain(line,
                            fmt::format("has {} fields; the header names {} columns", cells.size(), columns.size()));
        } else {
            reader.begin_row(line);
            for (std::size_t i = 0; i < cells.size(); ++i)
                if (columns[i] != nullptr) reader.read_text(*columns[i], cells[i]);
            reader.end_row();
        }
    };
    const std::string text = read_text(file, "a table of decals", kAnyLength);
    check_rows(file, static_cast<std::size_t>(std::ranges::count(text, '\n')), text.size());
    io::read_csv_rows(text, file.string(), io::CsvComments::lines, take);
    if (reader.header().empty())
        reader.complain_of_file(0, "holds no table; its first line names the columns, at least x,y,z");
    return reader.finish();
}

std::vector<Projector> load_npy(const std::filesystem::path& file, std::size_t textures) {
    const io::NpyRecords records(file);
    check_rows(file, records.rows(), records.file_bytes());
    DecalReader reader(file.string(), textures, DecalReader::Form::npy);
    std::vector<std::string> names;
    for (const io::NpyRecords::Field& field : records.fields()) names.push_back(field.name);
    reader.read_header(names, 0);
    for (std::size_t row = 0; row < records.rows(); ++row) {
        reader.begin_row(0);
        for (std::size_t i = 0; i < names.size(); ++i) {
            const DecalColumn* column = reader.header()[i];
            const io::NpyRecords::Field& field = records.fields()[i];
            if (column == nullptr) continue;
            if (field.is_text())
                reader.read_text(*column, records.text(row, field));
            else
                reader.read_number(*column, records.number(row, field));
        }
        reader.end_row();
    }
    return reader.finish();
}

std::string csv_text(std::span<const DecalColumn* const> columns, const std::vector<Projector>& rows) {
    std::string text;
    for (const DecalColumn* column : columns) {
        if (column != columns.front()) text += ',';
        text += column->name;
    }
    for (const Projector& row : rows) {
        text += '\n';
        for (const DecalColumn* column : columns) {
            if (column != columns.front()) text += ',';
            io::append_csv_cell(text, column->write(row));
        }
    }
    return text + '\n';
}

}  // namespace
}  // namespace scene

std::vector<Projector> load_decals(const std::filesystem::path& file, std::size_t textures) {
    return only_errors(file.c_str(), [&] {
        if (scene::is_toml(file)) return scene::load_decal_toml(file, textures);
        return io::NpyRecords::is(file) ? scene::load_npy(file, textures) : scene::load_csv(file, textures);
    });
}

void save_decals(const std::filesystem::path& file, const std::vector<Projector>& rows) {
    only_errors(file.c_str(), [&] {
        using namespace scene;
        // Columns that every row leaves at its default are left out.
        std::vector<const DecalColumn*> used;
        const Projector standard;
        for (const DecalColumn& column : decal_columns()) {
            const bool differs = std::ranges::any_of(
                rows, [&, usual = column.write(standard)](const Projector& row) { return column.write(row) != usual; });
            if (differs || &column < decal_columns().data() + kRequiredColumns) used.push_back(&column);
        }
        AtomicFile out(file);
        out.write(is_toml(file) ? decal_toml(used, rows) : csv_text(used, rows));
        out.commit();
    });
}

}  // namespace wrinkle
