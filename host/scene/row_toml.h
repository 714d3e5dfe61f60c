#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/row_kind.h"

namespace wrinkle::scene {

/// Whether a table is TOML: by its name, .toml.
bool is_toml(const std::filesystem::path& file);

/// Reads a table: a [[decal]] a row, or what the kind is called, with the keys of the columns. As load_rows.
template <class Row>
std::vector<Row> load_row_toml(const std::filesystem::path& file, const RowKind<Row>& kind);

/// The rows as such a table, with the keys of these columns.
template <class Row>
std::string row_toml(const RowKind<Row>& kind, std::span<const Column<Row>* const> columns,
                     const std::vector<Row>& rows);

}  // namespace wrinkle::scene
