#pragma once

#include <string>

namespace wrinkle {

/// What a compiler's log says is wrong, a line each: "dents.clh:12: use of undeclared identifier 'k'". The whole log
/// where no line of it is told in a form that is known.
std::string build_errors(const std::string& log);

}  // namespace wrinkle
