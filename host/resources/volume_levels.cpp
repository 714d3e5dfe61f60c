#include "resources/volume_levels.h"

#include "resources/coarse_blocks.h"

namespace wrinkle {

namespace {

/// Whether the grid's box is more than two voxels wide on a level.
bool is_wide(const Volume& volume, int level) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int first = Volume::edge * volume.first[axis], last = first + Volume::edge * volume.count[axis] - 1;
        if ((last >> level) - (first >> level) > 1) return true;
    }
    return false;
}

}  // namespace

std::vector<Volume> coarser_levels(const Volume& volume) {
    std::vector<Volume> levels;
    for (int level = 0; is_wide(volume, level); ++level) levels.push_back(half_of(level == 0 ? volume : levels.back()));
    return levels;
}

}  // namespace wrinkle
