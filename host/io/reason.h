#pragma once

#include <string>

namespace wrinkle::io {

/// A library's message, to be put behind our own: one line of it, as " (message)". Empty when it gave none.
std::string reason(std::string text);

}  // namespace wrinkle::io
