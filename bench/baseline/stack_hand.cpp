#include <immintrin.h>

#include <experimental/simd>

#include "stack_job.h"

// The stack vectorised by hand with std::experimental::simd. Each load fetches two neighbouring texels of two channels;
// those of four pixels are then transposed into vectors.
namespace wrinkle::baseline {

namespace {

namespace stdx = std::experimental;

template <int width>
struct Lanes {
    using Real = stdx::simd<float, stdx::simd_abi::deduce_t<float, width>>;
    using Index = stdx::rebind_simd_t<int, Real>;
    using Mask = typename Real::mask_type;

    struct Vector {
        Real x, y, z;
    };
    struct Slope {
        Real s, t;
    };

    static Real dot(const float* a, const Vector& b) { return a[0] * b.x + (a[1] * b.y + a[2] * b.z); }
    static Real dot(const Vector& a, const Vector& b) { return a.x * b.x + (a.y * b.y + a.z * b.z); }
    static Real choose(const Mask& mask, const Real& yes, const Real& no) {
        Real out = no;
        stdx::where(mask, out) = yes;
        return out;
    }
    static Real joined(const __m128* parts) {
        if constexpr (width == 8) return Real(_mm256_set_m128(parts[1], parts[0]));
#ifdef WRINKLE_BASELINE_AVX512
        else
            return Real(_mm512_insertf32x8(_mm512_castps256_ps512(_mm256_set_m128(parts[1], parts[0])),
                                           _mm256_set_m128(parts[3], parts[2]), 1));
#endif
    }

    static Slope bilinear(const StackDecal& d, const Real& qx, const Real& qy) {
        const Real x = qx * (0.5F * static_cast<float>(d.width)) + (0.5F * static_cast<float>(d.width) + 0.5F);
        const Real y = qy * (0.5F * static_cast<float>(d.height)) + (0.5F * static_cast<float>(d.height) + 0.5F);
        const Index column = stdx::static_simd_cast<Index>(x), row = stdx::static_simd_cast<Index>(y);
        const Real tx = x - stdx::static_simd_cast<Real>(column), ty = y - stdx::static_simd_cast<Real>(row);
        alignas(64) int low[width];
        alignas(64) float up[width];
        (2 * (row * d.stride + column)).copy_to(low, stdx::vector_aligned);
        ty.copy_to(up, stdx::vector_aligned);
        __m128 s_left[width / 4], t_left[width / 4], s_right[width / 4], t_right[width / 4];
        for (int group = 0; group < width / 4; ++group) {
            __m128 v[4];
            for (int k = 0; k < 4; ++k) {
                const float* texel = d.slopes + low[4 * group + k];
                const __m128 bottom = _mm_loadu_ps(texel), top = _mm_loadu_ps(texel + 2 * d.stride);
                v[k] = _mm_fmadd_ps(_mm_set1_ps(up[4 * group + k]), _mm_sub_ps(top, bottom), bottom);
            }
            _MM_TRANSPOSE4_PS(v[0], v[1], v[2], v[3]);
            s_left[group] = v[0], t_left[group] = v[1], s_right[group] = v[2], t_right[group] = v[3];
        }
        const Real s0 = joined(s_left), t0 = joined(t_left);
        return {s0 + tx * (joined(s_right) - s0), t0 + tx * (joined(t_right) - t0)};
    }

    static Real edge(const Real& inside, float slope) { return stdx::min(inside * slope, Real(1)); }

    static void add(const StackDecal& d, const Vector& p, const Vector& n, const Mask& valid, Vector& g) {
        const Real qx = dot(d.to_x, p) - d.centre[0], qy = dot(d.to_y, p) - d.centre[1],
                   qz = dot(d.to_z, p) - d.centre[2];
        const Real ax = 1 - stdx::abs(qx), ay = 1 - stdx::abs(qy), az = 1 - stdx::abs(qz);
        const Mask inside = valid && stdx::min(ax, stdx::min(ay, az)) >= 0;
        if (stdx::none_of(inside)) return;
        const Real facing = stdx::min(stdx::max((dot(d.axis_z, n) - d.fade_from) * d.per_fade, Real(0)), Real(1));
        const Real fades = edge(ax, d.per_falloff) * edge(ay, d.per_falloff) * edge(az, d.per_falloff) * facing;
        const Real weight = choose(inside, fades, 0);
        const Slope slope = bilinear(d, choose(inside, qx, 0), choose(inside, qy, 0));
        const Real s = weight * slope.s, t = weight * slope.t;
        g.x += s * d.grad_s[0] + t * d.grad_t[0];
        g.y += s * d.grad_s[1] + t * d.grad_t[1];
        g.z += s * d.grad_s[2] + t * d.grad_t[2];
    }

    static Mask finite(const Real& v) { return (v - v) == 0; }
    static Real loaded(const float* plane, int at, int count) {
        if (count >= width) return Real(plane + at, stdx::element_aligned);
        return Real([&](auto k) { return static_cast<int>(k) < count ? plane[at + static_cast<int>(k)] : 0.0F; });
    }
    static void stored(float* plane, int at, int count, const Real& v) {
        if (count >= width)
            v.copy_to(plane + at, stdx::element_aligned);
        else
            for (int k = 0; k < count; ++k) plane[at + k] = v[static_cast<std::size_t>(k)];
    }

    /// The next `width` pixels of a row, or as many as it still has.
    static void pixels(const StackJob& job, int x, int y) {
        const int at = y * job.width + x, count = job.width - x;
        const Vector raw{loaded(job.n_x, at, count), loaded(job.n_y, at, count), loaded(job.n_z, at, count)};
        const Real z = loaded(job.depth, at, count), square = dot(raw, raw);
        const Mask known = finite(raw.x) && finite(raw.y) && finite(raw.z);
        const Mask valid = known && z > 0 && z < 1e9F && square > 0;
        Vector out{choose(known, raw.x, 0), choose(known, raw.y, 0), choose(known, raw.z, 0)};
        if (stdx::any_of(valid)) {
            const Real fx = Real([](auto k) { return static_cast<float>(k) + 0.5F; }) + static_cast<float>(x);
            const float fy = static_cast<float>(y) + 0.5F;
            const Vector p{z * (fx * job.dx[0] + (job.d0[0] + fy * job.dy[0])),
                           z * (fx * job.dx[1] + (job.d0[1] + fy * job.dy[1])),
                           z * (fx * job.dx[2] + (job.d0[2] + fy * job.dy[2]))};
            const Real inverse = 1 / stdx::sqrt(square);
            Vector n{raw.x * inverse, raw.y * inverse, raw.z * inverse};
            const Real away = dot(n, p);
            if (stdx::any_of(valid && away > 0)) {
                const Real back = choose(away > 0, 2 * away / dot(p, p), 0);
                n = {n.x - back * p.x, n.y - back * p.y, n.z - back * p.z};
            }
            Vector g{0, 0, 0};
            for (int k = 0; k < job.count; ++k) add(job.decals[k], p, n, valid, g);
            const Real along = dot(n, g) + 1;
            const Vector m{n.x * along - g.x, n.y * along - g.y, n.z * along - g.z};
            const Real length = 1 / stdx::sqrt(dot(m, m));
            out = {choose(valid, m.x * length, out.x), choose(valid, m.y * length, out.y),
                   choose(valid, m.z * length, out.z)};
        }
        stored(job.out_x, at, count, out.x);
        stored(job.out_y, at, count, out.y);
        stored(job.out_z, at, count, out.z);
    }
};

template <int width>
void rows(const StackJob& job, int first, int last) {
    for (int y = first; y < last; ++y)
        for (int x = 0; x < job.width; x += width) Lanes<width>::pixels(job, x, y);
}

}  // namespace

#ifdef WRINKLE_BASELINE_AVX2
void stack_rows_hand8(const StackJob& job, int first, int last) { rows<8>(job, first, last); }
#endif
#ifdef WRINKLE_BASELINE_AVX512
void stack_rows_hand16(const StackJob& job, int first, int last) { rows<16>(job, first, last); }
#endif

}  // namespace wrinkle::baseline
