#include "tests/cases/registry.h"

#include "tests/cases/height_map.h"
#include "tests/cases/noise.h"
#include "tests/cases/resolve.h"
#include "tests/cases/screen_derivative.h"
#include "tests/cases/surface_gradient.h"
#include "tests/cases/tangent_frame.h"
#include "tests/cases/tangent_normal.h"
#include "tests/cases/texcoord.h"
#include "tests/cases/triplanar.h"
#include "tests/cases/volume.h"

namespace wrinkle::cases {

const std::map<std::string, Cases (*)()>& registry() {
    static const std::map<std::string, Cases (*)()> all{
        {"golden_march", golden_march_cases},
        {"golden_ratio", golden_ratio_cases},
        {"height_slope_plain", [] { return height_slope_cases(false); }},
        {"height_slope_smooth", [] { return height_slope_cases(true); }},
        {"perlin_noise", noise_cases},
        {"remap_ramp", [] { return remap_cases(Remap::ramp); }},
        {"remap_smooth", [] { return remap_cases(Remap::smooth); }},
        {"remap_wave", [] { return remap_cases(Remap::wave); }},
        {"resolve", resolve_cases},
        {"screen_derivatives", [] { return screen_derivative_cases(true); }},
        {"screen_derivatives_general", [] { return screen_derivative_cases(false); }},
        {"surface_gradient_from_tbn", tbn_cases},
        {"surface_gradient_from_volume", volume_gradient_cases},
        {"surface_gradient_scale_dependent", scale_dependent_cases},
        {"tangent_frame", tangent_frame_cases},
        {"tangent_normal_slope", tangent_normal_cases},
        {"texture_step", texcoord_step_cases},
        {"triplanar_gradient", triplanar_gradient_cases},
        {"triplanar_weights", triplanar_weight_cases},
        {"volume_bspline", [] { return volume_cases(TexelKind::volume_smooth); }},
        {"volume_trilinear", [] { return volume_cases(TexelKind::volume); }},
        {"volume_vector", volume_vector_cases},
    };
    return all;
}

}  // namespace wrinkle::cases
