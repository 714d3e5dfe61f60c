#pragma once

#include "tests/fuzz/fuzz.h"
#include "wrinkle/decal_layers.h"
#include "wrinkle/lighting.h"

namespace wrinkle::fuzz {

/// The bytes as a table of decals and as one of lights, which most are one of.
inline int with_tables(const std::uint8_t* data, std::size_t size, const char* extension) {
    return with_file(data, size, extension, [](const std::filesystem::path& file) {
        try {
            load_lights(file);
        } catch (const Error&) {}
        load_decals(file, 3);
    });
}

}  // namespace wrinkle::fuzz
