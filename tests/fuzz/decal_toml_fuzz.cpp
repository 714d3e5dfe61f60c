#include "tests/fuzz/table_fuzz.h"

WRINKLE_HARNESS(decal_toml_fuzz)(const std::uint8_t* data, std::size_t size) {
    return wrinkle::fuzz::with_tables(data, size, ".toml");
}
