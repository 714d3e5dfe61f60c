#pragma once

#include <stdexcept>
#include <string>

namespace wrinkle {

/// The one exception of the library. The text is written for the person who typed the command: which file, line or
/// channel, what was found, what was expected, what to do.
///
///     try {
///         wrinkle::load_scene("missing.toml");
///     } catch (const wrinkle::Error& error) {
///         std::cerr << error.what() << '\n';
///     }
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace wrinkle
