#pragma once

namespace wrinkle::test {

/// Whether the tests were built with a sanitizer, under which times and memory say nothing about the program.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace wrinkle::test
