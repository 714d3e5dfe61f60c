#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "wrinkle/scene.h"

namespace wrinkle::scene {

/// What fields of a column hold: numbers; names, or other text; yes or no.
enum class Field { number, name, truth };

/// A column of a table of decals. `read` takes a field that is not empty, and `take` a number; `wrong` looks at the
/// value that a row holds. All three return what is wrong with it, or an empty text. `write` returns the field of a
/// row.
struct DecalColumn {
    const char* name;
    const char* key;   ///< of TOML; the columns that share one are its elements, and follow one another
    std::size_t size;  ///< elements of the key; 0: a value by itself
    Field field;
    std::string (*read)(std::string_view field, Projector& row);
    std::string (*take)(double value, Projector& row);  ///< null: the column holds text only
    std::string (*wrong)(const Projector& row);
    std::string (*write)(const Projector& row);
};

/// The first columns have to be there.
constexpr std::size_t kRequiredColumns = 3;

std::span<const DecalColumn> decal_columns();

}  // namespace wrinkle::scene
