#include "baseline/volume.h"

#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/SampleFromVoxels.h>

namespace wrinkle::baseline {

struct NanoVolume::Grid {
    nanovdb::GridHandle<> handle;
};

NanoVolume::NanoVolume(int size, const std::function<float(int, int, int)>& voxel) : grid_(std::make_unique<Grid>()) {
    nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
    builder([&](const nanovdb::Coord& at) { return voxel(at[0], at[1], at[2]); },
            nanovdb::CoordBBox(nanovdb::Coord(0), nanovdb::Coord(size - 1)));
    grid_->handle = builder.getHandle();
}
NanoVolume::~NanoVolume() = default;

namespace {

template <class Work>
void each_point(const nanovdb::NanoGrid<float>& grid, std::span<const float> (&points)[3], const Work& work) {
    const auto count = static_cast<std::ptrdiff_t>(points[0].size());
#pragma omp parallel
    {
        const auto accessor = grid.getAccessor();
        const auto sampler = nanovdb::createSampler<1>(accessor);
#pragma omp for schedule(static)
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            const auto k = static_cast<std::size_t>(i);
            work(k, sampler, nanovdb::Vec3f(points[0][k], points[1][k], points[2][k]));
        }
    }
}

}  // namespace

void NanoVolume::gradients(std::span<const float> (&points)[3], std::span<float> (&gradients)[3]) const {
    each_point(*grid_->handle.grid<float>(), points, [&](std::size_t k, const auto& sampler, const nanovdb::Vec3f& p) {
        const auto g = sampler.gradient(p);
        for (int axis = 0; axis < 3; ++axis) gradients[axis][k] = g[axis];
    });
}

void NanoVolume::values_and_gradients(std::span<const float> (&points)[3], std::span<float> value,
                                      std::span<float> (&gradients)[3]) const {
    each_point(*grid_->handle.grid<float>(), points, [&](std::size_t k, const auto& sampler, const nanovdb::Vec3f& p) {
        value[k] = sampler(p);
        const auto g = sampler.gradient(p);
        for (int axis = 0; axis < 3; ++axis) gradients[axis][k] = g[axis];
    });
}

}  // namespace wrinkle::baseline
