#pragma once

#include <memory>
#include <vector>

#include "io/volume.h"
#include "tests/reference/volume.h"

namespace wrinkle::reference {

/// Means of the voxels of a grid over cubes of 2^k voxels an edge, aligned to voxel 0, up to the first k at which two
/// of them are as wide as the grid's box.
template <class T>
class VolumeMeans {
public:
    VolumeMeans(const Volume& volume, int channel) : background_(volume.constants[static_cast<std::size_t>(channel)]) {
        Level finest = empty_level(volume, 0);
        fill(finest, [&](int x, int y, int z) { return T(volume.at(x, y, z, channel)); });
        levels_.push_back(std::move(finest));
        while (is_wide(levels_.back())) {
            const int k = static_cast<int>(levels_.size());
            Level next = empty_level(volume, k);
            fill(next, [&](int x, int y, int z) {
                T sum = 0;
                for (int i = 0; i < 8; ++i) sum += at(k - 1, 2 * x + (i & 1), 2 * y + (i >> 1 & 1), 2 * z + (i >> 2));
                return sum / 8;
            });
            levels_.push_back(std::move(next));
        }
    }

    int last() const { return static_cast<int>(levels_.size()) - 1; }

    T at(int level, int x, int y, int z) const {
        const Level& l = levels_[static_cast<std::size_t>(level)];
        const int place[] = {x - l.first[0], y - l.first[1], z - l.first[2]};
        for (int axis = 0; axis < 3; ++axis)
            if (place[axis] < 0 || place[axis] >= l.size[axis]) return background_;
        return l.voxels[(static_cast<std::size_t>(place[2]) * l.size[1] + place[1]) * l.size[0] + place[0]];
    }

private:
    struct Level {
        int first[3], size[3];
        std::vector<T> voxels;
    };

    static Level empty_level(const Volume& volume, int k) {
        Level level{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int first = 8 * volume.first[axis], last = first + 8 * volume.count[axis] - 1;
            level.first[axis] = first >> k, level.size[axis] = (last >> k) - (first >> k) + 1;
        }
        return level;
    }

    static bool is_wide(const Level& level) { return level.size[0] > 2 || level.size[1] > 2 || level.size[2] > 2; }

    template <class Value>
    static void fill(Level& level, const Value& value) {
        for (int z = 0; z < level.size[2]; ++z)
            for (int y = 0; y < level.size[1]; ++y)
                for (int x = 0; x < level.size[0]; ++x)
                    level.voxels.push_back(value(level.first[0] + x, level.first[1] + y, level.first[2] + z));
    }

    T background_;
    std::vector<Level> levels_;
};

/// Value and gradient at p in the index space of the finest grid, as `sample` gives them of the voxels or of the means
/// over larger cubes, for a footprint that is 2^lod voxels long.
template <class T, class Sample>
NoiseValue<T> filtered_voxels(const VolumeMeans<T>& means, const Sample& sample, Vec<T> p, T lod) {
    NoiseValue<T> sum;
    for (int k = 0; k <= means.last(); ++k) {
        const T weight = std::max(T(0), 1 - std::abs(std::min(lod, T(means.last())) - T(k)));
        if (weight == 0) continue;
        const T size = std::ldexp(T(1), k);
        // The cube of number j spans voxels j size to (j + 1) size - 1.
        const auto on_level = [&](T x) { return (x - (size - 1) / 2) / size; };
        const Voxels<T> voxel = [&](int x, int y, int z) { return means.at(k, x, y, z); };
        const NoiseValue<T> v = sample(voxel, Vec<T>{on_level(p.x), on_level(p.y), on_level(p.z)});
        sum.value += weight * v.value;
        sum.gradient = sum.gradient + v.gradient * (weight / size);
    }
    return sum;
}

}  // namespace wrinkle::reference
