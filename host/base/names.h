#pragma once

#include <span>
#include <string>
#include <string_view>

/// Names in messages and comparisons.
namespace wrinkle {

std::string lower(std::string_view text);

/// Whether `text` contains `needle`, in upper or lower case.
bool contains_ignoring_case(std::string_view text, std::string_view needle);

/// `text` in double quotes, on one line, shortened when long: safe to print whatever the file held.
std::string quote(std::string_view text);

/// "a", "b", "c"
std::string quote_list(std::span<const std::string> names);

/// The known name that needs the fewest edits to become `name`, where case does not count. Empty without known names. A
/// swap of two neighbouring letters is one edit, since it is one slip of the fingers.
std::string nearest_name(std::string_view name, std::span<const std::string> known);

/// `; did you mean "scale"?`, or nothing when no known name is near.
std::string did_you_mean(std::string_view name, std::span<const std::string> known);

}  // namespace wrinkle
