#pragma once

#include <array>

#include "baseline.h"
#include "camera_terms.h"

namespace wrinkle::baseline {

/// A pixel of the G-buffer, decoded.
struct Decoded {
    float3 p;  ///< relative to the eye
    float3 n;  ///< unit, towards the viewer
    bool valid = false;
};

/// The planes of one frame as pointers; null where the frame has none.
class Frame {
public:
    using Plane = const float*;

    Frame(const Scene& scene, Size size, const CameraTerms& camera, const PlaneMap& planes);

    /// Null when the frame has no such plane. Throws Error when the plane is not of the frame's size.
    Plane find(const std::string& name) const;
    /// A channel of the G-buffer by its own name; throws Error when there is none.
    Plane channel(const std::string& name) const;

    Decoded decode(int x, int y) const;
    std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
    float3 ray(int x, int y) const {
        return camera.d0 + (static_cast<float>(x) + 0.5F) * camera.dx + (static_cast<float>(y) + 0.5F) * camera.dy;
    }
    ScreenDerivatives screen_derivatives_at(int x, int y, float3 p, float3 n) const {
        if (camera.pinhole) return pinhole_derivatives(camera, ray(x, y), dot(n, p), n);
        return screen_derivatives(camera, p, n, static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    }

    int width, height;
    const CameraTerms& camera;
    std::array<Plane, 3> position{}, normal{}, dp_du{}, dp_dv{};
    std::array<Plane, 2> uv{}, duv_dx{}, duv_dy{};
    Plane depth = nullptr, object = nullptr;
    std::vector<std::array<Plane, 2>> cryptomatte;  ///< id, coverage per rank

private:
    template <std::size_t N>
    std::array<Plane, N> find(const std::string& role, const std::array<const char*, N>& suffixes) const;

    const PlaneMap& planes_;
    bool ray_distance_ = false;
};

/// A normal that faces away is reflected towards the viewer [Mik20 3.7]: n - 2 (v.n) v with v = -p / |p|.
inline float3 facing(float3 n, float3 p) {
    const float away = dot(n, p);
    if (away <= 0.0F) return n;
    return n - (2.0F * away / dot(p, p)) * p;
}

inline float3 at(const std::array<Frame::Plane, 3>& planes, std::size_t i) {
    return {planes[0][i], planes[1][i], planes[2][i]};
}
inline float2 at(const std::array<Frame::Plane, 2>& planes, std::size_t i) { return {planes[0][i], planes[1][i]}; }

/// Background, NaN, Inf and zero normals are not valid. Normals are normalised as in listing 9.
inline Decoded Frame::decode(int x, int y) const {
    const std::size_t i = index(x, y);
    const float3 n = at(normal, i);
    Decoded out;
    if (!finite(n) || zero(n)) return out;
    if (depth != nullptr) {
        const float z = depth[i];
        if (!finite(z) || !(z > 0.0F && z < 1e9F)) return out;
        const float3 d = ray(x, y);
        out.p = (ray_distance_ ? z / std::sqrt(dot(d, d)) : z) * d;
    } else {
        const float3 position_world = at(position, i);
        if (!finite(position_world)) return out;
        out.p = position_world - camera.eye;
    }
    out.n = facing(normalize(n), out.p);
    out.valid = true;
    return out;
}

}  // namespace wrinkle::baseline
