#include "scene/row_claim.h"

#include <fmt/format.h>

#include "base/claim.h"
#include "base/limits.h"
#include "wrinkle/error.h"

namespace wrinkle::scene {

void check_rows(const std::filesystem::path& file, const RowClaim& row, std::size_t rows, std::uint64_t file_bytes) {
    constexpr double kUnasked = 256e6, kRowOverText = 32;
    const auto count = static_cast<double>(rows), bytes = static_cast<double>(file_bytes);
    const std::string what = fmt::format("a table of {} {}s", rows, row.name);
    check_memory(file.string(), row.in_all * count, what);
    if (row.in_table * count > kUnasked + kRowOverText * bytes && !is_memory_set())
        throw Error(
            fmt::format("{}: {} in a file of {} would take {} of memory; if it is meant, allow that by --memory or "
                        "WRINKLE_MEMORY, in GB",
                        file.string(), what, bytes_text(bytes), bytes_text(row.in_all * count)));
}

}  // namespace wrinkle::scene
