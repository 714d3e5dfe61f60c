#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace wrinkle {

/// One HTML page that needs no other file: page.html with its style and scripts, and `data` as page.js reads them:
/// title, status, size, views, layers, problems, warnings, tables, source, marked. Names may hold anything: nothing of
/// the data ends the element that they are in, and the scripts show them as text. `live`: with live.js.
std::string page_of(const nlohmann::json& data, bool live);

/// JSON for scripts. It is UTF-8, whatever names of files hold.
std::string page_json(const nlohmann::json& data);

}  // namespace wrinkle
