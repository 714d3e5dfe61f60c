#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "device/program.h"
#include "wrinkle/device.h"

namespace wrinkle {

/// Kernel text over columns of numbers. `body` sees each column under its name (a.x, a.y, a.z as vec3 a; a.x, a.y as
/// vec2 a; in_a_x is the whole column, `at` the first row of the
/// work-item), `constants`, `records`, `texels` and `textures`; `outputs` are expressions of type real.
struct ColumnKernel {
    std::string body;
    std::vector<std::string> outputs;
};

/// What kernels read beside columns: `constants` and `records` are WR_SCALARs (wr_camera, wr_light; wr_decal ...).
/// Where the ..._per_row are set, each row has its own that many of them.
struct ColumnData {
    std::vector<double> constants, records;
    std::size_t constants_per_row = 0, records_per_row = 0;
    std::vector<float> texels;
    std::vector<std::uint32_t> textures;
};

/// The kernel's source for columns of these names.
std::string column_kernel_source(const ColumnKernel& kernel, const std::vector<std::string>& columns,
                                 const ColumnData& data);

/// A built kernel with its columns on the device: upload, enqueue as often as wanted, read. T is float or double, and
/// so the kernel's numbers.
template <class T>
class ColumnProgram {
public:
    ColumnProgram(const Device& device, const ColumnKernel& kernel, const std::vector<std::string>& columns, int lanes,
                  const ColumnData& data);

    /// Columns in the order of the names, `rows` numbers each.
    void upload(const std::vector<std::vector<T>>& columns, std::size_t rows, const std::vector<double>& constants,
                const std::vector<double>& records);
    /// After what was enqueued before, which writes the same results.
    void enqueue();
    /// One vector of `rows` numbers for each output, once all that was enqueued is done.
    std::vector<std::vector<T>> read();
    /// Writes the program to the disk cache; after the first kernel ran.
    void save() { save_program(built_); }
    BuildSource source() const { return built_.source; }

private:
    Device device_;
    std::size_t outputs_, lanes_, rows_ = 0, stride_ = 0;
    BuiltProgram built_;
    cl::Buffer texels_, textures_;  // kernels do not hold on to their arguments
    std::vector<cl::Buffer> arguments_;
    cl::Kernel kernel_;
    std::vector<cl::Event> last_;  ///< that was enqueued
};

/// One vector of numbers for each output; every column has as many rows. T is float or double, and so the kernel's.
template <class T>
std::vector<std::vector<T>> run_columns(const Device& device, const ColumnKernel& kernel,
                                        const std::map<std::string, std::span<const T>>& columns, int lanes,
                                        const ColumnData& data);

}  // namespace wrinkle
