// What nearly every source of the library includes, parsed once. Sources still include what they use: without
// precompiled headers (-D CMAKE_DISABLE_PRECOMPILE_HEADERS=ON) they compile all the same.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wrinkle/device.h"
#include "wrinkle/scene.h"
