#include "uv.h"

#include <algorithm>

#include "wrinkle/error.h"

namespace wrinkle::baseline {

UvTransform::UvTransform(const UvMapping& mapping, const CameraTerms& camera)
    : planar(mapping.source == UvSource::planar) {
    const double c = std::cos(mapping.rotation), s = std::sin(mapping.rotation);
    const double m[2][2] = {{c * mapping.scale[0], -s * mapping.scale[1]},
                            {s * mapping.scale[0], c * mapping.scale[1]}};
    double constant[2] = {mapping.offset[0], mapping.offset[1]};
    row_s = {static_cast<float>(m[0][0]), static_cast<float>(m[0][1])};
    row_t = {static_cast<float>(m[1][0]), static_cast<float>(m[1][1])};
    Vec3 axes[2]{};
    const Vec3 eye{camera.eye.x, camera.eye.y, camera.eye.z};
    for (int i = 0; i < 2; ++i) {
        for (int k = 0; k < 3; ++k) {
            axes[i][k] = m[i][0] * mapping.axis_u[k] + m[i][1] * mapping.axis_v[k];
            if (planar) constant[i] += axes[i][k] * eye[k];
        }
    }
    axis_s = to_float3(axes[0]);
    axis_t = to_float3(axes[1]);
    offset = {static_cast<float>(constant[0]), static_cast<float>(constant[1])};
}

UvDerivatives uv_derivatives(const Frame& frame) {
    if (frame.uv[0] == nullptr)
        throw Error("baseline: a layer needs texture coordinates, but there are no planes uv.u .v");
    if (frame.duv_dx[0] != nullptr && frame.duv_dy[0] != nullptr) return UvDerivatives::planes;
    if (frame.dp_du[0] != nullptr && frame.dp_dv[0] != nullptr) return UvDerivatives::tangents;
    return UvDerivatives::neighbours;
}

RowWindow::RowWindow(const Frame& frame) : frame_(frame) {
    for (auto& row : rows_) row.resize(static_cast<std::size_t>(frame.width));
}

void RowWindow::move_to(int y) {
    const int from = std::max(0, y - 1), to = std::min(frame_.height - 1, y + 1);
    for (int row = from; row <= to; ++row) {
        if (row >= first_ && row <= last_) continue;
        for (int x = 0; x < frame_.width; ++x) rows_[(row + 3) % 3][x] = frame_.decode(x, row);
    }
    first_ = from;
    last_ = to;
}

namespace {

/// Least squares of dp = a dp_du + b dp_dv.
bool tangent_derivatives(float3 dp_du, float3 dp_dv, float3 dp_dx, float3 dp_dy, Uv& out) {
    const float uu = dot(dp_du, dp_du), uv = dot(dp_du, dp_dv), vv = dot(dp_dv, dp_dv);
    const float det = uu * vv - uv * uv;
    if (!(det > 0.0F)) return false;
    const float inverse = 1.0F / det;
    const auto solve = [&](float3 dp) {
        const float u = dot(dp, dp_du), v = dot(dp, dp_dv);
        return float2{inverse * (vv * u - uv * v), inverse * (uu * v - uv * u)};
    };
    out.dst_dx = solve(dp_dx);
    out.dst_dy = solve(dp_dy);
    return true;
}

/// A step along the surface, and the change of the texture coordinates along it.
struct Change {
    float2 uv;
    float3 step;
};

/// The change towards the pixel at (x + step_x, y + step_y). False when that pixel lies on another surface, or across a
/// seam of the texture coordinates.
bool difference(const Frame& frame, const RowWindow& window, int x, int y, int step_x, int step_y, float reach2,
                float2 uv, Change& out) {
    const int nx = x + step_x, ny = y + step_y;
    if (nx < 0 || ny < 0 || nx >= frame.width || ny >= frame.height) return false;
    const std::size_t j = frame.index(nx, ny);
    const Decoded &pixel = window.at(x, y), &other = window.at(nx, ny);
    if (!other.valid || dot(pixel.n, other.n) <= 0.5F) return false;
    if (frame.object != nullptr && frame.object[j] != frame.object[frame.index(x, y)]) return false;
    const float3 step = other.p - pixel.p;
    if (dot(step, step) > reach2) return false;
    const float2 uv_j = at(frame.uv, j);
    if (!finite(uv_j.x) || !finite(uv_j.y)) return false;
    const float sign = static_cast<float>(step_x + step_y);
    out = {sign * (uv_j - uv), sign * step};
    return std::abs(out.uv.x) < 0.5F && std::abs(out.uv.y) < 0.5F;
}

bool axis_change(const Frame& frame, const RowWindow& window, int x, int y, int step_x, int step_y, float3 dp,
                 float2 uv, Change& out) {
    const float reach2 = 16.0F * dot(dp, dp);
    Change forward, backward;
    const bool has_forward = difference(frame, window, x, y, step_x, step_y, reach2, uv, forward);
    const bool has_backward = difference(frame, window, x, y, -step_x, -step_y, reach2, uv, backward);
    if (!has_forward && !has_backward) return false;
    if (!has_forward || !has_backward) {
        out = has_forward ? forward : backward;
        return true;
    }
    const float f2 = dot(forward.uv, forward.uv), b2 = dot(backward.uv, backward.uv);
    if (std::fmax(f2, b2) > 4.0F * std::fmin(f2, b2)) {
        out = f2 < b2 ? forward : backward;
    } else {
        out = {0.5F * (forward.uv + backward.uv), 0.5F * (forward.step + backward.step)};
    }
    return true;
}

/// Texture coordinates change linearly near a pixel: finds the linear map that explains both changes, and what it gives
/// for steps of dp_dx and dp_dy.
void derivatives_from_changes(const Change& x, const Change& y, const ScreenDerivatives& d, Uv& out) {
    out.dst_dx = x.uv;
    out.dst_dy = y.uv;
    const float3 normal = cross(d.dp_dx, d.dp_dy);
    const float square = dot(normal, normal);
    if (!(square > 0.0F)) return;
    const auto in_pixels = [&](float3 step) {
        return (1.0F / square) * float2{dot(cross(step, d.dp_dy), normal), dot(cross(d.dp_dx, step), normal)};
    };
    const float2 a = in_pixels(x.step), b = in_pixels(y.step);
    const float area = a.x * b.y - a.y * b.x;
    if (!(area > 1.0F / 64.0F)) return;
    const float inverse = 1.0F / area;
    out.dst_dx = inverse * (b.y * x.uv - a.y * y.uv);
    out.dst_dy = inverse * (a.x * y.uv - b.x * x.uv);
}

}  // namespace

/// Texture coordinates belong to the rendered surface. So dp_dx and dp_dy are those of the base normal here, also in
/// later stages, whose normals are bumped.
bool aov_uv(const Frame& frame, UvDerivatives kind, const RowWindow& window, int x, int y, Uv& out) {
    const std::size_t i = frame.index(x, y);
    out.st = at(frame.uv, i);
    if (!finite(out.st.x) || !finite(out.st.y)) return false;
    if (kind == UvDerivatives::planes) {
        out.dst_dx = at(frame.duv_dx, i);
        out.dst_dy = at(frame.duv_dy, i);
        return finite(out.dst_dx.x) && finite(out.dst_dx.y) && finite(out.dst_dy.x) && finite(out.dst_dy.y);
    }
    if (kind == UvDerivatives::tangents) {
        const Decoded pixel = frame.decode(x, y);
        const ScreenDerivatives d = frame.screen_derivatives_at(x, y, pixel.p, pixel.n);
        return tangent_derivatives(at(frame.dp_du, i), at(frame.dp_dv, i), d.dp_dx, d.dp_dy, out);
    }
    const Decoded& pixel = window.at(x, y);
    const ScreenDerivatives d = frame.screen_derivatives_at(x, y, pixel.p, pixel.n);
    Change to_x, to_y;
    if (!axis_change(frame, window, x, y, 1, 0, d.dp_dx, out.st, to_x) ||
        !axis_change(frame, window, x, y, 0, 1, d.dp_dy, out.st, to_y))
        return false;
    derivatives_from_changes(to_x, to_y, d, out);
    return true;
}

}  // namespace wrinkle::baseline
