#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/decal_columns.h"

namespace wrinkle::scene {

/// Whether a table of decals is TOML: by its name, .toml.
bool is_toml(const std::filesystem::path& file);

/// Reads a table of decals: a [[decal]] a row, with the keys of the columns. As load_decals.
std::vector<Projector> load_decal_toml(const std::filesystem::path& file, std::size_t textures);

/// The rows as such a table, with the keys of these columns.
std::string decal_toml(std::span<const DecalColumn* const> columns, const std::vector<Projector>& rows);

}  // namespace wrinkle::scene
