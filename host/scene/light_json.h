#pragma once

#include <filesystem>
#include <vector>

#include "scene/table.h"
#include "wrinkle/lighting.h"

namespace wrinkle::scene {

/// Whether a file of lights is JSON: by its name, .json.
bool is_json(const std::filesystem::path& file);

/// Adds the lights of a JSON file, {"lights": [{"kind": "sun", ...}, ...]}, whose keys and values are those of
/// [[light]]. What is wrong with one goes to the problems of `table`, which names the file by its key `key`.
void read_light_json(Table& table, std::string_view key, const std::filesystem::path& file, std::vector<Light>& out);

}  // namespace wrinkle::scene
