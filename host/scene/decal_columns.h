#pragma once

#include <span>
#include <string>
#include <string_view>

#include "wrinkle/scene.h"

namespace wrinkle::scene {

/// A column of a table of decals. `read` takes a field that is not empty, `take` a number, and each says what is wrong
/// with it, or nothing; `write` gives the field.
struct DecalColumn {
    const char* name;
    std::string (*read)(std::string_view field, Projector& row);
    std::string (*take)(double value, Projector& row);  ///< null: the column holds text only
    std::string (*write)(const Projector& row);
};

std::span<const DecalColumn> decal_columns();

}  // namespace wrinkle::scene
