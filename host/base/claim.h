#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace wrinkle {

/// What a few bytes of a file say will come, before memory is taken for it.
struct Claim {
    std::string_view what;         ///< "a picture of 65535x65535 pixels"
    double wanted = 0;             ///< bytes of memory; a product of sides may be beyond any integer
    std::uint64_t file_bytes = 0;  ///< size of the file that says so
    double expansion = 0;          ///< the most bytes of memory that a byte of this kind of file can become
};

/// Throws Error, naming the file and what it claims, unless the file is large enough to hold that and memory_limit()
/// allows it, or the claim is too small to matter (kHarmless).
void check_claim(const std::string& name, const Claim& claim);

inline constexpr double kHarmless = 64 << 20;

/// Deflate, the compression of PNG, ZIP and many others, makes at most so many bytes of one.
inline constexpr double kDeflate = 1032;

/// "1.5 GB".
std::string bytes_text(double bytes);

}  // namespace wrinkle
