#pragma once

#include <string>
#include <vector>

#include "io/info.h"

namespace wrinkle {

/// What a use of a frame still lacks.
struct Readiness {
    std::string use;                    ///< a kind of layer, "lighting", "mask by object" ...
    std::vector<std::string> missing;   ///< roles; empty: ready
    std::vector<std::string> defaults;  ///< roles the scene's constants stand in for
};

/// Every kind of layer, lighting and masks: whether the frame has what they need.
std::vector<Readiness> readiness(const GBufferInfo& info);

}  // namespace wrinkle
