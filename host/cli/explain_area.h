#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "wrinkle/device.h"
#include "wrinkle/scene.h"

/// What `wrinkle explain` says of the areas that pixels show: what the table of costs (`wrinkle tune`) expects the
/// scene's taps to miss of them, layer by layer, beside one tap.
namespace wrinkle::cli {

/// Without a device, by the first table that comes with wrinkle.
void print_areas(const Scene& scene, const std::optional<Device>& device);
nlohmann::json areas_json(const Scene& scene, const std::optional<Device>& device);

}  // namespace wrinkle::cli
