#include "tests/cases/registry.h"

#include "tests/cases/blend.h"
#include "tests/cases/decal.h"
#include "tests/cases/displacement.h"
#include "tests/cases/fractal.h"
#include "tests/cases/height_map.h"
#include "tests/cases/neighbours.h"
#include "tests/cases/noise.h"
#include "tests/cases/object_scale.h"
#include "tests/cases/parallax.h"
#include "tests/cases/perturbed_normal.h"
#include "tests/cases/projector.h"
#include "tests/cases/prologue.h"
#include "tests/cases/resolve.h"
#include "tests/cases/screen_derivative.h"
#include "tests/cases/surface_gradient.h"
#include "tests/cases/tangent_frame.h"
#include "tests/cases/tangent_normal.h"
#include "tests/cases/texcoord.h"
#include "tests/cases/texture_metres.h"
#include "tests/cases/triplanar.h"
#include "tests/cases/volume.h"

namespace wrinkle::cases {

using reference::Cell;
using reference::Octaves;
using Value = reference::NoiseValue<real>;

constexpr real difference_margin = 1e-2L;  // in cells; several times the step of a difference

const std::map<std::string, Cases (*)()>& registry() {
    static const std::map<std::string, Cases (*)()> all{
        {"blend_linear", [] { return blend_cases("linear", reference::blend_linear<real>); }},
        {"blend_partial_derivative", [] { return blend_cases("want_pd", reference::blend_partial_derivative<real>); }},
        {"blend_rnm", [] { return blend_cases("want_rnmN", reference::blend_rnm<real>); }},
        {"blend_udn", [] { return blend_cases("want_udn", reference::blend_udn<real>); }},
        {"blend_whiteout", [] { return blend_cases("want_whiteout", reference::blend_whiteout<real>); }},
        {"combine_linear", [] { return combine_cases(reference::Blending::linear); }},
        {"combine_rnm", [] { return combine_cases(reference::Blending::rnm); }},
        {"combine_towards", combine_towards_cases},
        {"combine_udn", [] { return combine_cases(reference::Blending::udn); }},
        {"combine_whiteout", [] { return combine_cases(reference::Blending::whiteout); }},
        {"displace", displace_cases},
        {"displace_curved", displace_curved_cases},
        {"facing_normal", facing_cases},
        {"fractal_sum", [] { return fractal_cases(Octaves::sum); }},
        {"golden_march", golden_march_cases},
        {"golden_ratio", golden_ratio_cases},
        {"height_slope_plain", [] { return height_slope_cases(false); }},
        {"height_slope_smooth", [] { return height_slope_cases(true); }},
        {"height_taps", height_tap_cases},
        {"normal_offset", normal_offset_cases},
        {"parallax_march", parallax_march_cases},
        {"parallax_normal", parallax_normal_cases},
        {"perlin1985_noise", [] { return perlin_cases(true); }},
        {"perlin1985_noise_central", [] { return perlin_cases(true); }},
        {"perlin1985_noise_forward", [] { return perlin_cases(true); }},
        {"perlin_noise", [] { return perlin_cases(false); }},
        {"perlin_noise_central", [] { return perlin_cases(false); }},
        {"perlin_noise_forward", [] { return perlin_cases(false); }},
        {"perturb_perlin_1985", perlin_perturbation_cases},
        {"planar_texcoord", planar_cases},
        {"project_to_texture", project_to_texture_cases},
        {"projector_angle_fade", projector_cases},
        {"projector_bumped_axis", projector_golden_cases},
        {"projector_gradient", projector_cases},
        {"projector_locate", projector_cases},
        {"projector_step", projector_cases},
        {"rebase", rebase_cases},
        {"reorient_normal", reorient_cases},
        {"resolve", resolve_cases},
        {"resolve_object", object_scale_cases},
        {"ridged_multifractal", [] { return fractal_cases(Octaves::ridged); }},
        {"screen_derivatives", [] { return screen_derivative_cases(true); }},
        {"screen_derivatives_general", [] { return screen_derivative_cases(false); }},
        {"shape_bias",
         [] { return shape_cases({0.25}, [](const Value& f) { return reference::shape_bias(f, 0.25L); }); }},
        {"shape_power",
         [] { return shape_cases({2.5}, [](const Value& f) { return reference::shape_power(f, 2.5L); }); }},
        {"shape_ramp",
         [] {
             return shape_cases({1, -2}, [](const Value& f) { return reference::shape_ramp(f, 1.0L, -2.0L); });
         }},
        {"shape_remap",
         [] {
             return shape_cases({-0.5, 2}, [](const Value& f) { return reference::shape_remap(f, -0.5L, 2.0L); });
         }},
        {"shape_smoothstep",
         [] {
             return shape_cases({-0.25, 0.75},
                                [](const Value& f) { return reference::shape_smoothstep(f, -0.25L, 0.75L); });
         }},
        {"shape_wave",
         [] {
             const auto phase = [](real value) { return 2 * std::numbers::pi_v<real> * (value + 0.5L) / 2.5L; };
             return shape_cases(
                 {-0.5, 2}, [](const Value& f) { return reference::shape_wave(f, -0.5L, 2.0L); },
                 [=](real value) { return 1 + 1 / std::abs(std::cos(phase(value))); });
         }},
        {"simplex_noise", [] { return simplex_cases(1 << 20); }},
        {"simplex_noise_central", [] { return simplex_cases(512); }},
        {"simplex_noise_forward", [] { return simplex_cases(512); }},
        {"surface_gradient_from_perturbed_normal", perturbed_normal_cases},
        {"surface_gradient_from_screen_slope", screen_slope_cases},
        {"surface_gradient_from_tbn", tbn_cases},
        {"surface_gradient_from_volume", volume_gradient_cases},
        {"surface_gradient_scale_dependent", scale_dependent_cases},
        {"surface_gradient_to_world", object_scale_cases},
        {"tangent_frame", tangent_frame_cases},
        {"tangent_normal_slope", tangent_normal_cases},
        {"tangent_normal_slope_xy", tangent_normal_xy_cases},
        {"texture_derivatives", texcoord_changes_cases},
        {"texture_metres", texture_metres_cases},
        {"texture_offset_to_surface", texture_offset_cases},
        {"texture_step", texcoord_step_cases},
        {"triplanar_gradient", triplanar_gradient_cases},
        {"triplanar_object_normals", triplanar_normal_cases},
        {"triplanar_weights", triplanar_weight_cases},
        {"turbulence", [] { return fractal_cases(Octaves::turbulence); }},
        {"two_sided_normal", two_sided_cases},
        {"vertex_frame", vertex_frame_cases},
        {"volume_bspline", [] { return volume_cases(TexelKind::volume_smooth); }},
        {"volume_trilinear", [] { return volume_cases(TexelKind::volume); }},
        {"volume_vector", volume_vector_cases},
        {"worley_f1", [] { return worley_cases(Cell::f1); }},
        {"worley_f1_central", [] { return worley_cases(Cell::f1, difference_margin); }},
        {"worley_f1_forward", [] { return worley_cases(Cell::f1, difference_margin); }},
        {"worley_f2", [] { return worley_cases(Cell::f2); }},
        {"worley_f2_central", [] { return worley_cases(Cell::f2, difference_margin); }},
        {"worley_f2_f1", [] { return worley_cases(Cell::f2_f1); }},
        {"worley_f2_f1_central", [] { return worley_cases(Cell::f2_f1, difference_margin); }},
        {"worley_f2_f1_forward", [] { return worley_cases(Cell::f2_f1, difference_margin); }},
        {"worley_f2_forward", [] { return worley_cases(Cell::f2, difference_margin); }},
    };
    return all;
}

}  // namespace wrinkle::cases
