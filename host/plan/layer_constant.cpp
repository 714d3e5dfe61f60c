#include <fmt/format.h>

#include "plan/layer_text.h"

namespace wrinkle {

std::string emit(LayerText& at, const ConstantLayer& l) {
    at.section.operations += 6;
    return at.volume(literal(l.gradient));
}

}  // namespace wrinkle
