#pragma once

#include "io/gbuffer_reader.h"

namespace wrinkle::io {

/// The share of a frame's pixels whose normal is the mean of several surfaces', by a look at some of its rows: it is
/// well under unit length, where most normals have that. 0 where normals of no unit length are the rule.
double mixed_normals(const GBufferReader& reader);

}  // namespace wrinkle::io
