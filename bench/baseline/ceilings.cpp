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

/// Listing 1 on planes. The compiler cannot prove nine spans apart, so it is told.
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

void copy(ConstPlanes in, Planes out) {
    require_same(in, out);
    const auto count = static_cast<std::ptrdiff_t>(in.x.size());
    const float *ix = in.x.data(), *iy = in.y.data(), *iz = in.z.data();
    float *ox = out.x.data(), *oy = out.y.data(), *oz = out.z.data();
#pragma omp parallel for simd
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        ox[i] = ix[i];
        oy[i] = iy[i];
        oz[i] = iz[i];
    }
}

}  // namespace wrinkle::baseline
