#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/row_kind.h"

namespace wrinkle::scene {

/// Reads a table of rows: CSV, TOML (.toml) or .npy. Throws Error with what is wrong, the first mistakes in full.
template <class Row>
std::vector<Row> load_rows(const std::filesystem::path& file, const RowKind<Row>& kind);

/// The rows as CSV, with these columns.
template <class Row>
std::string row_csv(std::span<const Column<Row>* const> columns, const std::vector<Row>& rows);

}  // namespace wrinkle::scene
