#pragma once

#include <string>
#include <string_view>

namespace wrinkle {

/// `text` with $NAME and ${NAME} replaced by what the environment has under these names. $F and $F4 stay: they stand
/// for a frame's number. Throws Error for a name that is not set, or where a sandbox is: a scene of somebody else is
/// not to learn what the environment holds.
std::string with_environment(std::string_view text);

}  // namespace wrinkle
