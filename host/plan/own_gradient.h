#pragma once

#include <optional>

#include "plan/section.h"

/// The surface gradient of each layer by itself, as outputs of the kernel: by how much the layer changed the sums.
namespace wrinkle {

/// Whether the scene wants it of this layer; one that bumps nothing itself has none.
bool writes_own_gradient(const Emitter& emitter, const Layer& layer);

/// Has a layer's section compute it. A section that is evaluated over pixels' areas adds each point's to a sum, which
/// own_sum_text() declares and own_store_text() stores; others store it themselves.
void add_own_gradient(Section& section, std::size_t index);
std::string own_sum_text(const Section& section);
std::string own_store_text(const Section& section);

/// The place in the scene of the layer that an output plane is of; nothing for other planes.
std::optional<std::size_t> layer_of_output(const std::string& plane);

}  // namespace wrinkle
