// What nearly every test and benchmark includes, parsed once. Sources still include what they use.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "functions/column_kernel.h"
#include "wrinkle/error.h"
#include "wrinkle/passes.h"
#include "wrinkle/scene.h"
