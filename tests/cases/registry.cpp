#include "tests/cases/registry.h"

#include "tests/cases/blend.h"
#include "tests/cases/decal.h"
#include "tests/cases/height_map.h"
#include "tests/cases/noise.h"
#include "tests/cases/object_scale.h"
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
        {"blend_linear", [] { return blend_cases("linear", reference::blend_linear<real>); }},
        {"blend_partial_derivative", [] { return blend_cases("want_pd", reference::blend_partial_derivative<real>); }},
        {"blend_rnm", [] { return blend_cases("want_rnmN", reference::blend_rnm<real>); }},
        {"blend_udn", [] { return blend_cases("want_udn", reference::blend_udn<real>); }},
        {"blend_whiteout", [] { return blend_cases("want_whiteout", reference::blend_whiteout<real>); }},
        {"combine_linear", [] { return combine_cases(reference::Blending::linear); }},
        {"combine_rnm", [] { return combine_cases(reference::Blending::rnm); }},
        {"combine_udn", [] { return combine_cases(reference::Blending::udn); }},
        {"combine_whiteout", [] { return combine_cases(reference::Blending::whiteout); }},
        {"decal_angle_fade", [] { return decal_box_cases(); }},
        {"decal_gradient", decal_gradient_cases},
        {"decal_locate", [] { return decal_box_cases(); }},
        {"decal_step", [] { return decal_box_cases(); }},
        {"height_slope_plain", [] { return height_slope_cases(false); }},
        {"height_slope_smooth", [] { return height_slope_cases(true); }},
        {"height_taps", height_tap_cases},
        {"normal_offset", normal_offset_cases},
        {"perlin_noise", noise_cases},
        {"perturb_perlin_1985", perlin_perturbation_cases},
        {"planar_texcoord", planar_cases},
        {"reorient_normal", reorient_cases},
        {"resolve", resolve_cases},
        {"resolve_object", object_scale_cases},
        {"screen_derivatives", [] { return screen_derivative_cases(true); }},
        {"screen_derivatives_general", [] { return screen_derivative_cases(false); }},
        {"surface_gradient_from_screen", screen_slope_cases},
        {"surface_gradient_from_tbn", tbn_cases},
        {"surface_gradient_from_volume", volume_gradient_cases},
        {"surface_gradient_scale_dependent", scale_dependent_cases},
        {"surface_gradient_to_world", object_scale_cases},
        {"tangent_frame", tangent_frame_cases},
        {"tangent_normal_slope", tangent_normal_cases},
        {"texture_step", texcoord_step_cases},
        {"triplanar_gradient", triplanar_gradient_cases},
        {"triplanar_object_normals", triplanar_normal_cases},
        {"triplanar_weights", triplanar_weight_cases},
    };
    return all;
}

}  // namespace wrinkle::cases
