#pragma once

#include <string>

namespace wrinkle::io {

/// A library's reason on one line, in parentheses with a blank before; empty when it gave none.
std::string reason(std::string text);

}  // namespace wrinkle::io
