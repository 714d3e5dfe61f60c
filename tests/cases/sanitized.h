#pragma once

#include "base/sanitizers.h"

namespace wrinkle::test {

/// Whether the tests were built with a sanitizer, under which times and memory say nothing about the program.
inline constexpr bool kSanitized = kAddressSanitizer || kThreadSanitizer;

}  // namespace wrinkle::test
