#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "scene/row_kind.h"

namespace wrinkle::scene {

/// What a row of a table takes of memory.
struct RowClaim {
    const char* name;  ///< RowKind's
    double in_table;   ///< bytes of the table itself
    double in_all;     ///< bytes with what kernels get of it
};

template <class Row>
RowClaim claim_of(const RowKind<Row>& kind) {
    return {kind.name, sizeof(Row), kind.bytes};
}

/// Asks for the memory of all rows before the first of them takes any. Rows of a few bytes each become far more memory
/// than their file is long; beyond what real tables come to, somebody has to have allowed it. Throws Error.
void check_rows(const std::filesystem::path& file, const RowClaim& row, std::size_t rows, std::uint64_t file_bytes);

}  // namespace wrinkle::scene
