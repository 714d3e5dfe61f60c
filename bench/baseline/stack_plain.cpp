#include <bit>
#include <cmath>
#include <cstdint>

#include "stack_job.h"

// Compiled twice, with different flags; WRINKLE_STACK_ROWS is the name of the function. Everything else is local to
// this file: were it inline in a header, the linker could take one build's code for both.
namespace wrinkle::baseline {

namespace {

struct float3 {
    float x, y, z;
};

float3 vector(const float* v) { return {v[0], v[1], v[2]}; }
float3 operator+(float3 a, float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
float3 operator-(float3 a, float3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
float3 operator*(float s, float3 a) { return {s * a.x, s * a.y, s * a.z}; }
float dot(float3 a, float3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float3 normalize(float3 a) { return (1.0F / std::sqrt(dot(a, a))) * a; }
float clamp01(float v) { return std::fmin(std::fmax(v, 0.0F), 1.0F); }
float lerp(float a, float b, float t) { return a + t * (b - a); }
bool finite(float v) { return (std::bit_cast<std::uint32_t>(v) & 0x7f800000U) != 0x7f800000U; }
bool finite(float3 v) { return finite(v.x) && finite(v.y) && finite(v.z); }

/// Listing 15 without its last step, the projection onto the surface: that is done once, for the sum.
float3 gradient(const StackDecal& decal, float3 p, float3 n) {
    const float qx = dot(vector(decal.to_x), p) - decal.centre[0];
    if (std::abs(qx) > 1.0F) return {};
    const float qy = dot(vector(decal.to_y), p) - decal.centre[1];
    if (std::abs(qy) > 1.0F) return {};
    const float qz = dot(vector(decal.to_z), p) - decal.centre[2];
    if (std::abs(qz) > 1.0F) return {};
    float weight = clamp01((dot(n, vector(decal.axis_z)) - decal.fade_from) * decal.per_fade);
    const auto edge = [&](float q) { return std::fmin((1.0F - std::abs(q)) * decal.per_falloff, 1.0F); };
    weight *= edge(qx) * edge(qy) * edge(qz);
    if (weight == 0.0F) return {};
    const float x = (0.5F * qx + 0.5F) * static_cast<float>(decal.width) + 0.5F;
    const float y = (0.5F * qy + 0.5F) * static_cast<float>(decal.height) + 0.5F;
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float tx = x - static_cast<float>(column), ty = y - static_cast<float>(row);
    const float* low = decal.slopes + 2 * (row * decal.stride + column);
    const float* high = low + 2 * decal.stride;
    const float ds = lerp(lerp(low[0], low[2], tx), lerp(high[0], high[2], tx), ty);
    const float dt = lerp(lerp(low[1], low[3], tx), lerp(high[1], high[3], tx), ty);
    return (weight * ds) * vector(decal.grad_s) + (weight * dt) * vector(decal.grad_t);
}

}  // namespace

void WRINKLE_STACK_ROWS(const StackJob& job, int first, int last) {
    for (int y = first; y < last; ++y) {
        for (int x = 0; x < job.width; ++x) {
            const int i = y * job.width + x;
            float3 n{job.n_x[i], job.n_y[i], job.n_z[i]};
            const float z = job.depth[i];
            if (!finite(n)) {
                n = {0, 0, 0};
            } else if (finite(z) && z > 0.0F && z < 1e9F && dot(n, n) > 0.0F) {
                const float3 p = z * (vector(job.d0) + (static_cast<float>(x) + 0.5F) * vector(job.dx) +
                                      (static_cast<float>(y) + 0.5F) * vector(job.dy));
                n = normalize(n);
                const float away = dot(n, p);
                if (away > 0.0F) n = n - (2.0F * away / dot(p, p)) * p;
                float3 g{0, 0, 0};
                for (int k = 0; k < job.count; ++k) g = g + gradient(job.decals[k], p, n);
                n = normalize(n - (g - dot(n, g) * n));
            }
            job.out_x[i] = n.x, job.out_y[i] = n.y, job.out_z[i] = n.z;
        }
    }
}

}  // namespace wrinkle::baseline
