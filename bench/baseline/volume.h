#pragma once

#include <functional>
#include <memory>
#include <span>

/// Gradients of a volume by NanoVDB's own C++: what the kernels must beat.
namespace wrinkle::baseline {

class NanoVolume {
public:
    /// A grid of size^3 voxels.
    NanoVolume(int size, const std::function<float(int, int, int)>& voxel);
    ~NanoVolume();
    NanoVolume(const NanoVolume&) = delete;
    NanoVolume& operator=(const NanoVolume&) = delete;

    /// By NanoVDB's trilinear sampler that caches the last cell, one for each thread. Points are in index space.
    void gradients(std::span<const float> (&points)[3], std::span<float> (&gradients)[3]) const;
    /// The same, and the values.
    void values_and_gradients(std::span<const float> (&points)[3], std::span<float> value,
                              std::span<float> (&gradients)[3]) const;

private:
    struct Grid;
    std::unique_ptr<Grid> grid_;
};

}  // namespace wrinkle::baseline
