#include <algorithm>
#include <limits>

#include "base/atomic_file.h"
#include "base/only_errors.h"
#include "scene/decal_columns.h"
#include "scene/row_table.h"
#include "scene/row_toml.h"

namespace wrinkle {

std::vector<Projector> load_decals(const std::filesystem::path& file, std::size_t textures) {
    return scene::load_rows(file, scene::decal_rows(textures));
}

void save_decals(const std::filesystem::path& file, const std::vector<Projector>& rows) {
    only_errors(file.c_str(), [&] {
        using namespace scene;
        const RowKind<Projector> kind = decal_rows(std::numeric_limits<std::size_t>::max());
        // Columns that every row leaves at its default are left out.
        std::vector<const Column<Projector>*> used;
        const Projector standard;
        for (const Column<Projector>& column : kind.columns) {
            const bool differs = std::ranges::any_of(
                rows, [&, usual = column.write(standard)](const Projector& row) { return column.write(row) != usual; });
            if (differs || &column < kind.columns.data() + kind.required) used.push_back(&column);
        }
        const std::span<const Column<Projector>* const> columns = used;
        AtomicFile out(file);
        out.write(is_toml(file) ? row_toml(kind, columns, rows) : row_csv(columns, rows));
        out.commit();
    });
}

}  // namespace wrinkle
