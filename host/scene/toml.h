#pragma once

// The only place that includes toml++, which toml.cpp builds: as Debian's library it reads floats by streams, and takes
// twice as long over a large table. Its version 3.3 asserts, or under clang with NDEBUG assumes, that keys begin well,
// although its next lines refuse those that do not: a file with "[=]" would end the program. So its assertions are off,
// whatever the build type; asserting nothing needs NDEBUG hidden, because toml++ overrides us under it.
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
