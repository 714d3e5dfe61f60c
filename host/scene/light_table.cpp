#include "scene/light_columns.h"
#include "scene/row_table.h"

namespace wrinkle {

std::vector<Light> load_lights(const std::filesystem::path& file) {
    return scene::load_rows(file, scene::light_rows());
}

}  // namespace wrinkle
