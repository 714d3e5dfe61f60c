#include <bit>
#include <cmath>
#include <cstdint>

#include "stack_job.h"

// The stack as one writes it for a compiler to vectorise: structures of arrays, blocks of pixels that fit the first
// cache, the loop over pixels innermost. Compiled by g++ and by clang++; WRINKLE_STACK_ROWS is the function's name.
namespace wrinkle::baseline {

namespace {

constexpr int kBlock = 256;

struct Block {
    alignas(64) float px[kBlock], py[kBlock], pz[kBlock], nx[kBlock], ny[kBlock], nz[kBlock];
    alignas(64) float gx[kBlock], gy[kBlock], gz[kBlock], qx[kBlock], qy[kBlock], weight[kBlock];
    alignas(64) int valid[kBlock];
};

bool finite(float v) { return (std::bit_cast<std::uint32_t>(v) & 0x7f800000U) != 0x7f800000U; }

void decode(const StackJob& job, Block& b, int at, int x0, int y, int count) {
    const float fy = static_cast<float>(y) + 0.5F;
    const float rx = job.d0[0] + fy * job.dy[0], ry = job.d0[1] + fy * job.dy[1], rz = job.d0[2] + fy * job.dy[2];
#pragma omp simd
    for (int i = 0; i < count; ++i) {
        const float z = job.depth[at + i], x = static_cast<float>(x0 + i) + 0.5F;
        const float nx = job.n_x[at + i], ny = job.n_y[at + i], nz = job.n_z[at + i];
        const float square = nx * nx + ny * ny + nz * nz;
        const bool valid = (z > 0.0F) & (z < 1e9F) & finite(nx) & finite(ny) & finite(nz) & (square > 0.0F);
        const float depth = valid ? z : 1.0F, inverse = valid ? 1.0F / std::sqrt(square) : 0.0F;
        const float px = depth * (rx + x * job.dx[0]), py = depth * (ry + x * job.dx[1]),
                    pz = depth * (rz + x * job.dx[2]);
        const float ux = nx * inverse, uy = ny * inverse, uz = nz * inverse;
        const float away = ux * px + uy * py + uz * pz;
        const float back = away > 0.0F ? 2.0F * away / (px * px + py * py + pz * pz) : 0.0F;
        b.valid[i] = valid;
        b.px[i] = px, b.py[i] = py, b.pz[i] = pz;
        b.nx[i] = ux - back * px, b.ny[i] = uy - back * py, b.nz[i] = uz - back * pz;
        b.gx[i] = b.gy[i] = b.gz[i] = 0.0F;
    }
}

/// Finds where the pixels lie in the box, and their weights. False when all of them lie outside.
bool locate(const StackDecal& d, Block& b, int count) {
    int any = 0;
#pragma omp simd reduction(| : any)
    for (int i = 0; i < count; ++i) {
        const float x = b.px[i], y = b.py[i], z = b.pz[i];
        const float qx = d.to_x[0] * x + d.to_x[1] * y + d.to_x[2] * z - d.centre[0];
        const float qy = d.to_y[0] * x + d.to_y[1] * y + d.to_y[2] * z - d.centre[1];
        const float qz = d.to_z[0] * x + d.to_z[1] * y + d.to_z[2] * z - d.centre[2];
        const float ax = 1.0F - std::abs(qx), ay = 1.0F - std::abs(qy), az = 1.0F - std::abs(qz);
        const float cosine = b.nx[i] * d.axis_z[0] + b.ny[i] * d.axis_z[1] + b.nz[i] * d.axis_z[2];
        float weight = (cosine - d.fade_from) * d.per_fade;
        weight = weight > 1.0F ? 1.0F : weight;
        weight = weight < 0.0F ? 0.0F : weight;
        const float ex = ax * d.per_falloff, ey = ay * d.per_falloff, ez = az * d.per_falloff;
        weight *= (ex < 1.0F ? ex : 1.0F) * (ey < 1.0F ? ey : 1.0F) * (ez < 1.0F ? ez : 1.0F);
        const bool inside = (ax >= 0.0F) & (ay >= 0.0F) & (az >= 0.0F);
        b.weight[i] = inside ? weight : 0.0F;
        b.qx[i] = inside ? qx : 0.0F, b.qy[i] = inside ? qy : 0.0F;
        any |= inside ? 1 : 0;
    }
    return any != 0;
}

void add(const StackDecal& d, Block& b, int count) {
    const float width = static_cast<float>(d.width), height = static_cast<float>(d.height);
#pragma omp simd
    for (int i = 0; i < count; ++i) {
        const float x = (0.5F * b.qx[i] + 0.5F) * width + 0.5F, y = (0.5F * b.qy[i] + 0.5F) * height + 0.5F;
        const int column = static_cast<int>(x), row = static_cast<int>(y);
        const float tx = x - static_cast<float>(column), ty = y - static_cast<float>(row);
        const int low = 2 * (row * d.stride + column), high = low + 2 * d.stride;
        const float* t = d.slopes;
        const float s0 = t[low] + tx * (t[low + 2] - t[low]), s1 = t[high] + tx * (t[high + 2] - t[high]);
        const float t0 = t[low + 1] + tx * (t[low + 3] - t[low + 1]),
                    t1 = t[high + 1] + tx * (t[high + 3] - t[high + 1]);
        const float ds = b.weight[i] * (s0 + ty * (s1 - s0)), dt = b.weight[i] * (t0 + ty * (t1 - t0));
        b.gx[i] += ds * d.grad_s[0] + dt * d.grad_t[0];
        b.gy[i] += ds * d.grad_s[1] + dt * d.grad_t[1];
        b.gz[i] += ds * d.grad_s[2] + dt * d.grad_t[2];
    }
}

void resolve(const StackJob& job, const Block& b, int at, int count) {
#pragma omp simd
    for (int i = 0; i < count; ++i) {
        const float along = b.nx[i] * b.gx[i] + b.ny[i] * b.gy[i] + b.nz[i] * b.gz[i];
        const float x = b.nx[i] - (b.gx[i] - along * b.nx[i]), y = b.ny[i] - (b.gy[i] - along * b.ny[i]),
                    z = b.nz[i] - (b.gz[i] - along * b.nz[i]);
        const float inverse = 1.0F / std::sqrt(x * x + y * y + z * z);
        const float kx = job.n_x[at + i], ky = job.n_y[at + i], kz = job.n_z[at + i];
        const bool keep = finite(kx) & finite(ky) & finite(kz);
        job.out_x[at + i] = b.valid[i] != 0 ? x * inverse : (keep ? kx : 0.0F);
        job.out_y[at + i] = b.valid[i] != 0 ? y * inverse : (keep ? ky : 0.0F);
        job.out_z[at + i] = b.valid[i] != 0 ? z * inverse : (keep ? kz : 0.0F);
    }
}

}  // namespace

void WRINKLE_STACK_ROWS(const StackJob& job, int first, int last) {
    Block block;
    for (int y = first; y < last; ++y)
        for (int x = 0; x < job.width; x += kBlock) {
            const int count = job.width - x < kBlock ? job.width - x : kBlock, at = y * job.width + x;
            decode(job, block, at, x, y, count);
            for (int k = 0; k < job.count; ++k)
                if (locate(job.decals[k], block, count)) add(job.decals[k], block, count);
            resolve(job, block, at, count);
        }
}

}  // namespace wrinkle::baseline
