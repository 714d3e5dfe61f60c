#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace wrinkle::io {

/// The object that a JSON file holds. Throws Error where it holds none, with the line where it is malformed. For
/// messages: `what` such files are called ("a camera file"), and what is expected in them.
nlohmann::json read_json_object(const std::filesystem::path& file, const char* what, const char* expected);

}  // namespace wrinkle::io
