#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "device/program.h"
#include "wrinkle/device.h"

namespace wrinkle {

/// Kernel text over columns of numbers. `body` sees each column under its name: columns a.x, a.y, a.z as a wr_vec3 a,
/// and a.x, a.y as a wr_vec2 a. It also sees the whole column as in_a_x, with `at` for the first row of the work-item,
/// and `constants`, `records`, `texels` and `textures`. `outputs` are expressions of type wr_real.
struct ColumnKernel {
    std::string body;
    std::vector<std::string> outputs;
};

/// What kernels read beside columns. `constants` are WR_SCALARs, or structs of them such as a wr_camera; `records` are
/// rows such as wr_projectors. Where a ..._per_row is set, every row of the columns has that many of its own.
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
    /// Enqueues the kernel to run after what was enqueued before, because all of them write the same results.
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
