#ifdef __AVX__
#include <immintrin.h>
#endif

#include <cmath>

#include "baseline.h"
#include "surface_gradient.h"
#include "wrinkle/error.h"

namespace wrinkle::baseline {
namespace {

template <class A, class B>
void require_same(const A& a, const B& b) {
    const std::size_t size = a.x.size();
    if (a.y.size() != size || a.z.size() != size || b.x.size() != size || b.y.size() != size || b.z.size() != size)
        throw Error("baseline: planes of different sizes");
}

}  // namespace

/// Listing 1 on planes. The compiler cannot prove that nine spans do not overlap, so "omp simd" says it.
void resolve(ConstPlanes n, ConstPlanes g, Planes out) {
    require_same(n, g);
    require_same(n, out);
    const auto count = static_cast<std::ptrdiff_t>(n.x.size());
    const float *nx = n.x.data(), *ny = n.y.data(), *nz = n.z.data();
    const float *gx = g.x.data(), *gy = g.y.data(), *gz = g.z.data();
    float *ox = out.x.data(), *oy = out.y.data(), *oz = out.z.data();
#pragma omp parallel for simd
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        const float3 r = resolve_normal({nx[i], ny[i], nz[i]}, {gx[i], gy[i], gz[i]});
        ox[i] = r.x;
        oy[i] = r.y;
        oz[i] = r.z;
    }
}

namespace {

constexpr std::ptrdiff_t kVector = 8;
using Vector = float __attribute__((vector_size(sizeof(float) * kVector), may_alias));

Vector at(const float* plane, std::ptrdiff_t i) { return *reinterpret_cast<const Vector*>(plane + i); }
void stream(float* plane, std::ptrdiff_t i, Vector v) {
#ifdef __AVX__
    _mm256_stream_ps(plane + i, v);
#else
    *reinterpret_cast<Vector*>(plane + i) = v;
#endif
}
/// Number of vectors, rounded up: planes are padded, so the last vector may reach beyond the last pixel.
std::ptrdiff_t vectors(std::size_t count) { return (static_cast<std::ptrdiff_t>(count) + kVector - 1) / kVector; }

}  // namespace

void resolve_streaming(ConstPlanes n, ConstPlanes g, Planes out) {
    require_same(n, g);
    require_same(n, out);
#pragma omp parallel for
    for (std::ptrdiff_t k = 0; k < vectors(n.x.size()); ++k) {
        const std::ptrdiff_t i = k * kVector;
        const Vector x = at(n.x.data(), i) - at(g.x.data(), i), y = at(n.y.data(), i) - at(g.y.data(), i),
                     z = at(n.z.data(), i) - at(g.z.data(), i), square = x * x + y * y + z * z;
        Vector inverse{};
        for (std::ptrdiff_t j = 0; j < kVector; ++j) inverse[j] = 1.0F / std::sqrt(square[j]);
        stream(out.x.data(), i, x * inverse);
        stream(out.y.data(), i, y * inverse);
        stream(out.z.data(), i, z * inverse);
    }
}

void triad_streaming(std::span<const float> a, std::span<const float> b, std::span<float> out) {
    if (a.size() != b.size() || a.size() != out.size()) throw Error("baseline: planes of different sizes");
#pragma omp parallel for
    for (std::ptrdiff_t k = 0; k < vectors(a.size()); ++k)
        stream(out.data(), k * kVector, at(a.data(), k * kVector) + 3.0F * at(b.data(), k * kVector));
}

}  // namespace wrinkle::baseline
