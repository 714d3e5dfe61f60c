#pragma once

#include <filesystem>
#include <span>

namespace wrinkle {

/// Throws Error when writing `output` would replace one of `inputs`, whatever names or links lead to it.
void refuse_to_replace(const std::filesystem::path& output, std::span<const std::filesystem::path> inputs);

}  // namespace wrinkle
