#pragma once

#include <string>

#include "plan/section.h"

namespace wrinkle {

/// Whether what the picture shows as specular is known, and relit apart from the rest.
bool specular_apart(const Emitter& emitter);

/// Whether lit_sky is what surfaces send on of the sky, not the irradiance / pi that falls on them. Surfaces of an edge
/// have albedos of their own, and what is added up is the light that they send on; and what they mirror does not depend
/// on the albedo.
bool sky_is_sent_on(const Emitter& emitter);

/// How many numbers of light pictures and of what is specular there are; those of lights read apart follow.
std::size_t shared_numbers(const Emitter& emitter);
/// How many lights have their shadows read each apart (lights_read_apart()).
std::size_t count_read_apart(const Emitter& emitter);

/// Text that puts the picture in the place of `lit` where the scene leaves it as it is.
std::string left_picture_text(Emitter& emitter, Section& section);

/// Text that sets `lit`, which holds what lights without pictures give, to the picture with the bumps.
std::string relight_text(Emitter& emitter, Section& section);

}  // namespace wrinkle
