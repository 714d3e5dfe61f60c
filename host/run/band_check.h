#pragma once

#include <string>
#include <vector>

#include "run/plane_buffers.h"

namespace wrinkle {

/// Looks at every band of a frame after it was evaluated and before it is written.
class BandCheck {
public:
    virtual ~BandCheck() = default;

    /// Planes that it reads, beside those of the pass.
    virtual const std::vector<std::string>& inputs() const = 0;

    /// A frame begins, in bands of `band_rows` rows, the last one shorter.
    virtual void start(const Camera& camera, std::uint32_t band_rows) = 0;

    /// The next band: its planes, and what a pass that has completed made of them, in double if `fp64`. Blocks.
    virtual void add(const PlaneBuffers& inputs, const Rows& rows, PlaneBuffers& outputs, bool fp64) = 0;
};

}  // namespace wrinkle
