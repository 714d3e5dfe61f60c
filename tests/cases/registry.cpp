#include "tests/cases/registry.h"

#include "tests/cases/height_map.h"
#include "tests/cases/noise.h"
#include "tests/cases/perturbed_normal.h"
#include "tests/cases/prologue.h"
#include "tests/cases/resolve.h"
#include "tests/cases/screen_derivative.h"
#include "tests/cases/surface_gradient.h"
#include "tests/cases/tangent_frame.h"
#include "tests/cases/tangent_normal.h"
#include "tests/cases/texcoord.h"
#include "tests/cases/texture_metres.h"
#include "tests/cases/triplanar.h"

namespace wrinkle::cases {

const std::map<std::string, Cases (*)()>& registry() {
    static const std::map<std::string, Cases (*)()> all{
        {"facing_normal", facing_cases},
        {"height_screen_slope", height_screen_slope_cases},
        {"height_slope_plain", [] { return height_slope_cases(false); }},
        {"height_slope_smooth", [] { return height_slope_cases(true); }},
        {"perlin_noise", noise_cases},
        {"rebase", rebase_cases},
        {"resolve", resolve_cases},
        {"screen_derivatives", [] { return screen_derivative_cases(true); }},
        {"screen_derivatives_general", [] { return screen_derivative_cases(false); }},
        {"surface_gradient_from_perturbed_normal", perturbed_normal_cases},
        {"surface_gradient_from_screen_slope", screen_slope_cases},
        {"surface_gradient_from_tbn", tbn_cases},
        {"surface_gradient_from_volume", volume_gradient_cases},
        {"surface_gradient_scale_dependent", scale_dependent_cases},
        {"tangent_frame", tangent_frame_cases},
        {"tangent_normal_slope", tangent_normal_cases},
        {"tangent_normal_slope_xy", tangent_normal_xy_cases},
        {"texture_metres", texture_metres_cases},
        {"texture_step", texcoord_step_cases},
        {"triplanar_gradient", triplanar_gradient_cases},
        {"triplanar_weights", triplanar_weight_cases},
        {"two_sided_normal", two_sided_cases},
        {"vertex_frame", vertex_frame_cases},
    };
    return all;
}

}  // namespace wrinkle::cases
