#pragma once

#include <algorithm>

#include "wrinkle/scene.h"

namespace wrinkle {

/// The texel, of `size` along an axis, that stands for number i, which may lie outside.
inline int wrapped(int i, int size, Wrap wrap) {
    return wrap == Wrap::clamp ? std::clamp(i, 0, size - 1) : ((i % size) + size) % size;
}

}  // namespace wrinkle
