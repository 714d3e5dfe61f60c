#pragma once

#include "frame.h"

namespace wrinkle::baseline {

/// Texture coordinates with their screen derivatives.
struct Uv {
    float2 st, dst_dx, dst_dy;
};

/// A UvMapping as constants. For planar coordinates, the axes and the offset hold the mapping and the eye's position.
struct UvTransform {
    bool planar = false;
    float2 row_s, row_t;    ///< aov: s = row_s . (u,v) + offset.x
    float3 axis_s, axis_t;  ///< planar: s = axis_s . p + offset.x, p relative to the eye
    float2 offset;

    UvTransform() = default;
    UvTransform(const UvMapping& mapping, const CameraTerms& camera);

    Uv of_aov(const Uv& in) const {
        const auto linear = [this](float2 v) { return float2{dot(row_s, v), dot(row_t, v)}; };
        return {linear(in.st) + offset, linear(in.dst_dx), linear(in.dst_dy)};
    }
    Uv of_position(float3 p, float3 dp_dx, float3 dp_dy) const {
        const auto linear = [this](float3 v) { return float2{dot(axis_s, v), dot(axis_t, v)}; };
        return {linear(p) + offset, linear(dp_dx), linear(dp_dy)};
    }
};

/// Where the screen derivatives of the UV plane come from; decided once per frame.
enum class UvDerivatives { planes, tangents, neighbours };
UvDerivatives uv_derivatives(const Frame& frame);

/// Keeps rows y-1, y and y+1 decoded, one window for each thread. Without it, a pixel would be decoded five times: for
/// itself and for each of its four neighbours.
class RowWindow {
public:
    explicit RowWindow(const Frame& frame);
    void move_to(int y);
    const Decoded& at(int x, int y) const { return rows_[(y + 3) % 3][x]; }

private:
    const Frame& frame_;
    int first_ = 0, last_ = -1;  // rows held
    std::array<std::vector<Decoded>, 3> rows_;
};

/// Texture coordinates of a pixel with their derivatives. False where they have none. `window` is used only when `kind`
/// is `neighbours`.
bool aov_uv(const Frame& frame, UvDerivatives kind, const RowWindow& window, int x, int y, Uv& out);

}  // namespace wrinkle::baseline
