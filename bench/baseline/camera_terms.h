#pragma once

#include "vec.h"

namespace wrinkle::baseline {

/// What the pixels need of a camera, computed once in double. Positions are relative to the eye.
struct CameraTerms {
    float3 eye;
    bool pinhole = false;
    float3 d0, dx, dy;  ///< pinhole: the ray d(x, y) = d0 + x dx + y dy has view depth 1
    float4 columns[4];  ///< of the inverse view-projection-screen matrix: mInvViewProjScrT[i] of listing 10
};

CameraTerms camera_terms(const Camera& camera, Size size);

struct ScreenDerivatives {
    float3 dp_dx, dp_dy;
};

constexpr float float_epsilon = 1.1920929e-7F;  ///< FLT_EPSILON

/// [Mik20 listing 10], as printed. pos and norm in the space of the matrix.
inline ScreenDerivatives screen_derivatives(const CameraTerms& camera, float3 pos, float3 norm, float x0, float y0) {
    const float4* m_inv_t = camera.columns;
    const float4 plane{norm.x, norm.y, norm.z, -dot(pos, norm)};
    const float4 plane_scr{dot(m_inv_t[0], plane), dot(m_inv_t[1], plane), dot(m_inv_t[2], plane),
                           dot(m_inv_t[3], plane)};
    const float sign_z = plane_scr.z < 0.0F ? -1.0F : 1.0F;
    const float inverse_nz = 1.0F / (sign_z * std::fmax(float_epsilon, std::abs(plane_scr.z)));
    const float4 v0 = m_inv_t[0] + (-plane_scr.x * inverse_nz) * m_inv_t[2];
    const float4 v1 = m_inv_t[1] + (-plane_scr.y * inverse_nz) * m_inv_t[2];
    const float4 v2 = m_inv_t[3] + (-plane_scr.w * inverse_nz) * m_inv_t[2];
    const float4 ipw = x0 * v0 + y0 * v1 + v2;
    const float inverse_denom = 1.0F / std::fmax(float_epsilon, ipw.w * ipw.w);
    return {inverse_denom * (ipw.w * xyz(v0) - v0.w * xyz(ipw)), inverse_denom * (ipw.w * xyz(v1) - v1.w * xyz(ipw))};
}

/// Listing 10 for a pinhole camera: the surface's plane meets the ray d at z = n.p / n.d, so dz/dx = -z n.dx / n.d. The
/// division is guarded as in the listing. It takes half the arithmetic of the general form.
inline ScreenDerivatives pinhole_derivatives(const CameraTerms& camera, float3 d, float n_p, float3 n) {
    const float n_d = dot(n, d);
    const float guarded = n_d < 0.0F ? std::fmin(n_d, -float_epsilon) : std::fmax(n_d, float_epsilon);
    const float inverse = 1.0F / guarded;
    const float z = n_p * inverse;
    return {z * (camera.dx - (dot(n, camera.dx) * inverse) * d), z * (camera.dy - (dot(n, camera.dy) * inverse) * d)};
}

}  // namespace wrinkle::baseline
