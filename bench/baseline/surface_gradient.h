#pragma once

#include "vec.h"

/// The short listings of [Mik20], with their globals as parameters. dPdx and dPdy come from listing 10, so they are
/// perpendicular to the normal and equal to sigmaX and sigmaY (section 3.7).
namespace wrinkle::baseline {

/// Listing 1.
inline float3 resolve_normal(float3 n, float3 surf_grad) { return normalize(n - surf_grad); }

/// Listing 2. `flip` is gFlipVertDeriv.
inline float2 tspace_normal_to_derivative(float3 m, bool flip) {
    const float scale = 1.0F / 128.0F;
    const float z_ma = std::fmax(std::abs(m.z), scale * std::fmax(std::abs(m.x), std::abs(m.y)));
    if (z_ma == 0.0F) return {};
    return {-m.x / z_ma, (flip ? m.y : -m.y) / z_ma};
}

/// Listings 3 and 4 with the flip_sign of listing 9. Zero where texture coordinates are degenerate and have no frame.
inline float3 surfgrad_from_tangent_derivative(float2 deriv, float3 n, float3 dp_dx, float3 dp_dy, float2 dst_dx,
                                               float2 dst_dy) {
    const float det = dst_dx.x * dst_dy.y - dst_dx.y * dst_dy.x;
    if (det == 0.0F) return {};
    const float sign_det = det < 0.0F ? -1.0F : 1.0F;
    const float flip_sign = dot(dp_dy, cross(n, dp_dx)) < 0.0F ? -1.0F : 1.0F;
    const float3 t = normalize((sign_det * dst_dy.y) * dp_dx + (-sign_det * dst_dx.y) * dp_dy);
    return deriv.x * t + (deriv.y * sign_det * flip_sign) * cross(n, t);
}

/// Listing 6 with isDerivScreenSpace: dh_dxy are the screen derivatives of the height.
inline float3 surfgrad_scale_dependent(float2 dh_dxy, float3 n, float3 dp_dx, float3 dp_dy) {
    const float3 r1 = cross(dp_dy, n), r2 = cross(n, dp_dx);
    const float det = dot(dp_dx, r1);
    const float eps = 1.192093e-15F;
    const float s = (det < 0.0F ? -1.0F : 1.0F) / std::fmax(eps, std::abs(det));
    return (s * dh_dxy.x) * r1 + (s * dh_dxy.y) * r2;
}

/// Listing 8. Volume gradients add up (section 4.5), so a stage calls this once, for the sum of listings 13 and 15.
inline float3 surfgrad_from_volume_gradient(float3 n, float3 grad) { return grad - dot(n, grad) * n; }

/// Listing 13 without its last line, the projection.
inline float3 triplanar_volume_gradient(float3 w, float2 deriv_x, float2 deriv_y, float2 deriv_z) {
    return {w.z * deriv_z.x + w.y * deriv_y.x, w.z * deriv_z.y + w.x * deriv_x.y, w.x * deriv_x.x + w.y * deriv_y.y};
}

/// Listing 14. The published exponent, 3, has its own branch, since std::pow costs more than the rest of the layer.
inline float3 triplanar_weights(float3 n, float k) {
    float3 w{std::fmax(0.0F, std::abs(n.x) - 0.2F), std::fmax(0.0F, std::abs(n.y) - 0.2F),
             std::fmax(0.0F, std::abs(n.z) - 0.2F)};
    if (k == 3.0F) {
        w = {w.x * w.x * w.x, w.y * w.y * w.y, w.z * w.z * w.z};
    } else {
        w = {w.x > 0 ? std::pow(w.x, k) : 0, w.y > 0 ? std::pow(w.y, k) : 0, w.z > 0 ? std::pow(w.z, k) : 0};
    }
    return (1.0F / (w.x + w.y + w.z)) * w;
}

}  // namespace wrinkle::baseline
