#pragma once

#include <span>
#include <string>

namespace wrinkle::io {

/// Throws Error where several layers of a file are called as pictures are, and nothing says which is meant.
void require_one_beauty(std::span<const std::string> channels, const std::string& file);

}  // namespace wrinkle::io
