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

    /// The trilinear sampler that keeps its last cell; points in index space. Every thread has a sampler of its own.
    void gradients(std::span<const float> (&points)[3], std::span<float> (&gradients)[3]) const;
    /// The value from the same sampler, too.
    void values_and_gradients(std::span<const float> (&points)[3], std::span<float> value,
                              std::span<float> (&gradients)[3]) const;

private:
    struct Grid;
    std::unique_ptr<Grid> grid_;
};

}  // namespace wrinkle::baseline
