#pragma once

// The only place that includes toml++. Its version 3.3 asserts, or under clang with NDEBUG assumes, that keys begin
// well, although its next lines refuse those that do not: a file with "[=]" would end the program. So its assertions
// are off, whatever the build type; asserting nothing needs NDEBUG hidden, because toml++ overrides us under it.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) static_assert(true)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")
