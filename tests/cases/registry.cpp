#include "tests/cases/registry.h"

#include "tests/cases/displacement.h"
#include "tests/cases/height_map.h"
#include "tests/cases/noise.h"
#include "tests/cases/parallax.h"
#include "tests/cases/resolve.h"
#include "tests/cases/screen_derivative.h"
#include "tests/cases/surface_gradient.h"
#include "tests/cases/tangent_frame.h"
#include "tests/cases/tangent_normal.h"
#include "tests/cases/texcoord.h"
#include "tests/cases/triplanar.h"

namespace wrinkle::cases {

const std::map<std::string, Cases (*)()>& registry() {
    static const std::map<std::string, Cases (*)()> all{
        {"displace", displace_cases},
        {"displace_curved", displace_curved_cases},
        {"height_slope_plain", [] { return height_slope_cases(false); }},
        {"height_slope_smooth", [] { return height_slope_cases(true); }},
        {"parallax_march", parallax_march_cases},
        {"parallax_normal", parallax_normal_cases},
        {"perlin_noise", noise_cases},
        {"project_to_texture", project_to_texture_cases},
        {"resolve", resolve_cases},
        {"screen_derivatives", [] { return screen_derivative_cases(true); }},
        {"screen_derivatives_general", [] { return screen_derivative_cases(false); }},
        {"surface_gradient_from_tbn", tbn_cases},
        {"surface_gradient_from_volume", volume_gradient_cases},
        {"surface_gradient_scale_dependent", scale_dependent_cases},
        {"tangent_frame", tangent_frame_cases},
        {"tangent_normal_slope", tangent_normal_cases},
        {"texture_offset_to_surface", texture_offset_cases},
        {"texture_step", texcoord_step_cases},
        {"triplanar_gradient", triplanar_gradient_cases},
        {"triplanar_weights", triplanar_weight_cases},
    };
    return all;
}

}  // namespace wrinkle::cases
