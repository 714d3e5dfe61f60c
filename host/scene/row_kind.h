#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wrinkle::scene {

/// What fields of a column hold: numbers; names, or other text; yes or no.
enum class Field { number, name, truth };

/// A column of a table of rows. `read` takes a field that is not empty, and `take` a number; `wrong` looks at the value
/// that a row holds. All three return what is wrong with it, or an empty text. `write` returns the field of a row.
template <class Row>
struct Column {
    const char* name;
    const char* key;   ///< of TOML; the columns that share one are its elements, and follow one another
    std::size_t size;  ///< elements of the key; 0: a value by itself
    Field field;
    std::string (*read)(std::string_view field, Row& row);
    std::string (*take)(double value, Row& row);  ///< null: the column holds text only
    std::string (*wrong)(const Row& row);
    std::string (*write)(const Row& row);
};

/// Takes what is wrong with a row: the names of the columns that it is about, if any, and the rest of the sentence.
using Wrong = std::function<void(std::initializer_list<const char*> columns, const std::string& text)>;

/// What tables hold whose rows are of one kind.
template <class Row>
struct RowKind {
    const char* name;  ///< of a row: tables are "of decals", and of [[decal]] in TOML
    std::span<const Column<Row>> columns;
    std::size_t required;                         ///< so many of the first columns have to be there
    std::span<const std::string_view> uniform{};  ///< keys of which one number may stand for every element
    double bytes = 0;                             ///< of memory that a row takes in the end
    std::function<void(Row& row, std::uint32_t line)> begin{};         ///< a row that is about to be read; may be empty
    std::function<void(const Row& row, const Wrong& wrong)> together;  ///< tells what single fields cannot show
};

}  // namespace wrinkle::scene
