#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace wrinkle::cli {

/// JSON as it is printed. It is UTF-8, whatever names of files and channels hold: bytes that are none are replaced.
template <class Json>
std::string json_text(const Json& value, int indent = 2) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace wrinkle::cli
