#pragma once

#include <stdexcept>
#include <string>

namespace [[gnu::visibility("default")]] wrinkle {

/// The one exception of the library: what OpenCL, files or want of memory make fail arrives as an Error. (Where there
/// is no memory left even for a message or a name, std::bad_alloc is all that can be thrown.) The text is written for
/// the person who typed the command: which file, line or channel, what was found, what was expected, what to do.
///
/// Threads: a value; thrown where the library was called, also for work that it did on threads of its own.
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
