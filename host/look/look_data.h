#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "look/look.h"

/// Parts of what a page shows (look/page.h).
namespace wrinkle {

/// The pictures of an image, in pairs where there is something to compare with. `url` gives what a page finds a
/// picture by.
nlohmann::json views_of(const LookImage& image, const std::function<std::string(const std::string& picture)>& url);

nlohmann::json layers_of(const Scene& scene);

/// What the colours of marked pixels mean.
nlohmann::json marked_legend();

/// A message as problems of a file: "FILE:LINE: TEXT" belongs to its line, the rest to none.
nlohmann::json problems_of(const std::string& message, const std::string& file);

}  // namespace wrinkle
