#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "wrinkle/device.h"

namespace wrinkle {

/// Kernel text over columns of numbers. `body` sees each column under its name (a.x, a.y, a.z as vec3 a; a.x, a.y as
/// vec2 a; in_a_x is the whole column, `at` the first row of the
/// work-item), `constants`, `records`, `texels` and `textures`; `outputs` are expressions of type real.
struct ColumnKernel {
    std::string body;
    std::vector<std::string> outputs;
};

/// What kernels read beside columns: `constants` and `records` are WR_SCALARs (wr_frame, wr_light; wr_decal ...). Where
/// the ..._per_row are set, each row has its own that many of them.
struct ColumnData {
    std::vector<double> constants, records;
    std::size_t constants_per_row = 0, records_per_row = 0;
    std::vector<float> texels;
    std::vector<std::uint32_t> textures;
};

/// The kernel's source for columns of these names.
std::string column_kernel_source(const ColumnKernel& kernel, const std::vector<std::string>& columns,
                                 const ColumnData& data);

/// One vector of numbers for each output; every column has as many rows. T is float or double, and so the kernel's.
template <class T>
std::vector<std::vector<T>> run_columns(const Device& device, const ColumnKernel& kernel,
                                        const std::map<std::string, std::span<const T>>& columns, int lanes,
                                        const ColumnData& data);

}  // namespace wrinkle
