#include "resources/volume_products.h"

#include <algorithm>
#include <cmath>

#include "resources/coarse_blocks.h"

namespace wrinkle {

namespace {

constexpr int kEdge = Volume::edge;

/// Weights of voxels in a row for values and slopes, at the two points of Gauss's quadrature in a cell.
template <int count>
struct Basis {
    int first;  ///< of the voxels, from the one that the cell is numbered by
    float value[2][count], slope[2][count];
};

/// Of linear interpolation; products of two slopes are then integrated exactly.
Basis<2> linear_basis() {
    const auto low = static_cast<float>(0.5 - std::sqrt(1.0 / 12));
    return {0, {{1 - low, low}, {low, 1 - low}}, {{-1, 1}, {-1, 1}}};
}

/// Of the quadratic B-spline; off the integral by less than two in a hundred.
Basis<3> spline_basis() {
    Basis<3> basis{-1, {}, {}};
    for (int k = 0; k < 2; ++k) {
        const auto t = static_cast<float>((k == 0 ? -1 : 1) * std::sqrt(1.0 / 12));
        const float before = 0.5F - t, after = 0.5F + t;
        const float value[] = {before * before / 2, 0.75F - t * t, after * after / 2};
        const float slope[] = {-before, -2 * t, after};
        std::copy_n(value, 3, basis.value[k]), std::copy_n(slope, 3, basis.slope[k]);
    }
    return basis;
}

template <int count>
float weighed(const float (&weights)[count], const float (&numbers)[count]) {
    float sum = 0;
    for (int k = 0; k < count; ++k) sum += weights[k] * numbers[k];
    return sum;
}

/// The voxels that cells of a block of the next level reach, one row after another.
class Surroundings {
public:
    static constexpr int across = 2 * kEdge + 2;

    Surroundings(const Volume& fine, const std::array<int, 3>& block, int first) {
        voxels_.reserve(static_cast<std::size_t>(fine.info.channels) * across * across * across);
        for (int c = 0; c < fine.info.channels; ++c)
            for (int z = first; z < across + first; ++z)
                for (int y = first; y < across + first; ++y)
                    for (int x = first; x < across + first; ++x)
                        voxels_.push_back(fine.at(kEdge * block[0] + x, kEdge * block[1] + y, kEdge * block[2] + z, c));
    }

    /// The first voxel of a cell.
    const float* cell(int c, int x, int y, int z) const {
        return voxels_.data() + ((c * across + z) * across + y) * across + x;
    }

private:
    std::vector<float> voxels_;
};

/// Values of a cell at one of the two points along x, with the slopes there: a number for each row of voxels.
template <int count>
struct Rows {
    float value[count][count], slope[count][count];  // z, y

    Rows(const Basis<count>& basis, const float* cell, int point) {
        for (int z = 0; z < count; ++z)
            for (int y = 0; y < count; ++y) {
                float voxels[count];
                std::copy_n(cell + (z * Surroundings::across + y) * Surroundings::across, count, voxels);
                value[z][y] = weighed(basis.value[point], voxels);
                slope[z][y] = weighed(basis.slope[point], voxels);
            }
    }
};

/// Calls use(gradient) for the eight points of the quadrature in a cell of values.
template <int count, class Use>
void for_slopes(const Basis<count>& basis, const float* cell, const Use& use) {
    for (int i = 0; i < 2; ++i) {
        const Rows<count> rows(basis, cell, i);
        for (int j = 0; j < 2; ++j) {
            float value[count], along_x[count], along_y[count];
            for (int z = 0; z < count; ++z) {
                value[z] = weighed(basis.value[j], rows.value[z]);
                along_x[z] = weighed(basis.value[j], rows.slope[z]);
                along_y[z] = weighed(basis.slope[j], rows.value[z]);
            }
            for (int k = 0; k < 2; ++k)
                use(std::array{weighed(basis.value[k], along_x), weighed(basis.value[k], along_y),
                               weighed(basis.slope[k], value)});
        }
    }
}

/// The same in a cell of vectors, which are slopes.
template <int count, class Use>
void for_vectors(const Basis<count>& basis, const std::array<const float*, 3>& cell, const Use& use) {
    for (int i = 0; i < 2; ++i) {
        const Rows<count> rows[] = {{basis, cell[0], i}, {basis, cell[1], i}, {basis, cell[2], i}};
        for (int j = 0; j < 2; ++j)
            for (int k = 0; k < 2; ++k) {
                std::array<float, 3> vector{};
                for (std::size_t c = 0; c < 3; ++c)
                    for (int z = 0; z < count; ++z)
                        vector[c] += basis.value[k][z] * weighed(basis.value[j], rows[c].value[z]);
                use(vector);
            }
    }
}

/// The products of constant `number` of a grid: 0 unless it holds vectors.
std::array<double, 6> products_of_constant(const Volume& fine, std::size_t number) {
    if (fine.info.channels == 1) return {};
    const float* v = fine.constants.data() + 3 * number;
    const double x = v[0], y = v[1], z = v[2];
    return {x * x, x * y, x * z, y * y, y * z, z * z};
}

/// The means of products over the 2 x 2 x 2 cells of a voxel of the first coarser level: xx, xy, xz, yy, yz, zz.
template <int count>
std::array<float, 6> mean_products(const Basis<count>& basis, const Surroundings& around, bool vectors, int voxel) {
    std::array<float, 6> sums{};
    const auto add = [&](const std::array<float, 3>& g) {
        sums[0] += g[0] * g[0], sums[1] += g[0] * g[1], sums[2] += g[0] * g[2];
        sums[3] += g[1] * g[1], sums[4] += g[1] * g[2], sums[5] += g[2] * g[2];
    };
    for (int k = 0; k < 8; ++k) {
        const int x = 2 * (voxel & 7) + (k & 1), y = 2 * (voxel >> 3 & 7) + (k >> 1 & 1),
                  z = 2 * (voxel >> 6) + (k >> 2);
        if (vectors)
            for_vectors(basis, {around.cell(0, x, y, z), around.cell(1, x, y, z), around.cell(2, x, y, z)}, add);
        else
            for_slopes(basis, around.cell(0, x, y, z), add);
    }
    for (float& sum : sums) sum /= 64;
    return sums;
}

/// The products of the first coarser level.
template <int count>
SlopeProducts first_products(const Volume& fine, const Basis<count>& basis) {
    SlopeProducts out{coarse_box(fine, 3, 1), {}};
    Volume &first = out.first, &second = out.second;
    first.constants.clear();
    second.constants.clear();
    for (std::size_t i = 0; i < fine.constants.size() / 3; ++i) {
        const std::array<double, 6> p = products_of_constant(fine, i);
        for (std::size_t k = 0; k < 3; ++k) {
            first.constants.push_back(static_cast<float>(p[k]));
            second.constants.push_back(static_cast<float>(p[k + 3]));
        }
    }
    for_each_block(first, [&](std::size_t place, const std::array<int, 3>& block) {
        first.blocks[place] = common_constant(fine, block, basis.first, Surroundings::across + basis.first).value_or(0);
    });
    number_blocks(first, 2);
    second.info = first.info, second.first = first.first, second.count = first.count, second.blocks = first.blocks;
    second.voxels.resize(first.voxels.size());
    const bool vectors = fine.info.channels == 3;
    for_each_block(first, [&](std::size_t place, const std::array<int, 3>& block) {
        if (first.blocks[place] < 0) return;
        const Surroundings around(fine, block, basis.first);
        for (int voxel = 0; voxel < static_cast<int>(Volume::block_voxels); ++voxel) {
            const std::array<float, 6> products = mean_products(basis, around, vectors, voxel);
            for (int p = 0; p < 6; ++p)
                channel_of(p < 3 ? first : second, place, p % 3)[voxel] = products[static_cast<std::size_t>(p)];
        }
    });
    return out;
}

}  // namespace

std::vector<SlopeProducts> product_levels(const Volume& volume, VolumeFilter filter, std::size_t levels) {
    std::vector<SlopeProducts> all;
    for (std::size_t level = 0; level < levels; ++level)
        all.push_back(level > 0 ? SlopeProducts{half_of(all.back().first), half_of(all.back().second)}
                      : filter == VolumeFilter::smooth ? first_products(volume, spline_basis())
                                                       : first_products(volume, linear_basis()));
    return all;
}

}  // namespace wrinkle
