#include "budget/cost_table.h"

#include "tests/fuzz/fuzz.h"

WRINKLE_HARNESS(costs_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_file(data, size, ".json",
                                    [](const std::filesystem::path& file) { wrinkle::read_costs(file); });
}
