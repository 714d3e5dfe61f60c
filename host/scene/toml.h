#pragma once

// The only file that includes toml++. toml.cpp builds it: Debian's library reads floats by streams, and takes twice as
// long for a large table. Version 3.3 asserts (assumes, with clang and NDEBUG) that a key begins with a letter it may
// begin with, and only then reports the error if it does not: "[=]" would end the program. So its assertions are
// switched off in every build type. NDEBUG is hidden from it meanwhile, because with NDEBUG it ignores our TOML_ASSERT.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#define TOML_FLOAT_CHARCONV 1
#define TOML_HEADER_ONLY 0
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <cstdint>
#include <string>
#include <string_view>

namespace wrinkle::scene {

/// `text` as TOML. Throws Error with line and column, `name` and what is wrong; `first_line` is that of the text.
toml::table parse_toml(std::string_view text, const std::string& name, std::uint32_t first_line = 1);

/// A value as its author would recognise it.
std::string describe(const toml::node& node);

}  // namespace wrinkle::scene
