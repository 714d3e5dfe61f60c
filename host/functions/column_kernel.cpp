#include "functions/column_kernel.h"
#include "device/work_group.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "device/guarded.h"
#include "device/program.h"

namespace wrinkle {

namespace {

constexpr std::size_t kMostLanes = 16, kGroup = 16;
constexpr std::size_t kChunk = 64;                     // rows with constants of their own: constant buffers are small
constexpr std::size_t kLaunch = std::size_t{1} << 20;  // rows a launch, so that memory does not grow with the input

template <class T>
cl::Buffer buffer_of(const Device& device, std::vector<T> values) {
    if (values.empty()) values.push_back(T{});
    return {device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T), values.data()};
}

template <class T>
std::vector<T> narrowed(const std::vector<double>& values) {
    std::vector<T> out;
    std::ranges::transform(values, std::back_inserter(out), [](double v) { return static_cast<T>(v); });
    return out;
}

std::vector<double> slice(const std::vector<double>& all, std::size_t per_row, std::size_t first, std::size_t last) {
    if (per_row == 0) return all;
    const auto at = [&](std::size_t row) { return all.begin() + static_cast<std::ptrdiff_t>(row * per_row); };
    return {at(first), at(last)};
}

}  // namespace

template <class T>
ColumnProgram<T>::ColumnProgram(const Device& device, const ColumnKernel& kernel,
                                const std::vector<std::string>& columns, int lanes, const ColumnData& data)
    : device_(device),
      outputs_(kernel.outputs.size()),
      lanes_(static_cast<std::size_t>(lanes)),
      built_(build_program(device, column_kernel_source(kernel, columns, data), {lanes, std::is_same_v<T, double>})),
      texels_(buffer_of(device, data.texels)),
      textures_(buffer_of(device, data.textures)),
      kernel_(built_.program, "wr_columns") {
    kernel_.setArg(4, texels_);
    kernel_.setArg(5, textures_);
}

template <class T>
void ColumnProgram<T>::upload(const std::vector<std::vector<T>>& columns, std::size_t rows,
                              const std::vector<double>& constants, const std::vector<double>& records) {
    const std::size_t group = kGroup * kMostLanes;
    rows_ = rows, stride_ = (rows + group - 1) / group * group;
    std::vector<T> in;
    in.reserve(columns.size() * stride_);
    for (const std::vector<T>& column : columns) {
        in.insert(in.end(), column.begin(), column.end());
        in.insert(in.end(), stride_ - rows, column.empty() ? T{} : column.back());
    }
    arguments_ = {buffer_of(device_, std::move(in)),
                  cl::Buffer(device_.context, CL_MEM_READ_WRITE, outputs_ * stride_ * sizeof(T)),
                  buffer_of(device_, narrowed<T>(constants)), buffer_of(device_, narrowed<T>(records))};
    for (cl_uint i = 0; i < arguments_.size(); ++i) kernel_.setArg(i, arguments_[i]);
    kernel_.setArg(6, static_cast<cl_uint>(stride_));
    kernel_.setArg(7, static_cast<cl_uint>(rows_));
}

template <class T>
void ColumnProgram<T>::enqueue() {
    cl::Event done;
    device_.queue.enqueueNDRangeKernel(kernel_, {}, stride_ / lanes_, work_group(device_, kernel_, kGroup), &last_,
                                       &done);
    last_ = {done};
}

template <class T>
std::vector<std::vector<T>> ColumnProgram<T>::read() {
    std::vector<std::vector<T>> results(outputs_, std::vector<T>(rows_));
    for (std::size_t k = 0; k < outputs_; ++k)
        device_.queue.enqueueReadBuffer(arguments_[1], CL_TRUE, k * stride_ * sizeof(T), rows_ * sizeof(T),
                                        results[k].data(), &last_);
    return results;
}

template class ColumnProgram<float>;
template class ColumnProgram<double>;

std::string column_kernel_source(const ColumnKernel& kernel, const std::vector<std::string>& columns,
                                 const ColumnData& data) {
    std::string text =
        "#include \"wrinkle.clh\"\n\n"
        "wr_kernel void wr_columns(global const WR_SCALAR *restrict in, global WR_SCALAR *restrict out,\n"
        "    constant const WR_SCALAR *constants, global const WR_SCALAR *restrict records,\n"
        "    global const float *restrict texels, global const uint *restrict textures, uint stride, uint rows)\n{\n"
        "    size_t at = get_global_id(0) * WR_LANES;\n";
    if (data.constants_per_row + data.records_per_row > 0)  // such rows fill a work-item each
        text += fmt::format(
            "    size_t row = min(at, (size_t)(rows - 1)) / {};\n    constants += row * {}, records += row * {};\n",
            kMostLanes, data.constants_per_row, data.records_per_row);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const std::string &name = columns[k], base = name.substr(0, name.find('.')), suffix = name.substr(base.size());
        std::string id = name;
        std::ranges::replace(id, '.', '_');
        text += fmt::format(
            "    global const WR_SCALAR *in_{0} = in + {1} * stride; wr_real {0} = wr_load_real(in_{0}, at);\n", id, k);
        if (suffix == ".z") text += fmt::format("    wr_vec3 {0} = wr_v3({0}_x, {0}_y, {0}_z);\n", base);
        if (suffix == ".y" && std::ranges::find(columns, base + ".z") == columns.end())
            text += fmt::format("    wr_vec2 {0} = wr_v2({0}_x, {0}_y);\n", base);
    }
    text += kernel.body + "\n";
    for (std::size_t i = 0; i < kernel.outputs.size(); ++i)
        text += fmt::format("    wr_store({}, out + {} * stride, at);\n", kernel.outputs[i], i);
    return text + "}\n";
}

template <class T>
std::vector<std::vector<T>> run_columns(const Device& device, const ColumnKernel& kernel,
                                        const std::map<std::string, std::span<const T>>& columns, int lanes,
                                        const ColumnData& data) {
    return guarded("evaluating columns", [&] {
        std::vector<std::string> names;
        for (const auto& [name, values] : columns) names.push_back(name);
        ColumnProgram<T> program(device, kernel, names, lanes, data);
        const bool per_row = data.constants_per_row + data.records_per_row > 0;
        const std::size_t rows = columns.empty() ? 0 : columns.begin()->second.size(),
                          copies = per_row ? kMostLanes : 1, chunk = per_row ? kChunk : kLaunch;
        std::vector<std::vector<T>> results(kernel.outputs.size());
        for (std::size_t first = 0; first < rows; first += chunk) {
            const std::size_t last = std::min(first + chunk, rows);
            std::vector<std::vector<T>> part;
            for (const auto& [name, values] : columns) {
                part.emplace_back();
                for (std::size_t row = first; row < last; ++row)
                    part.back().insert(part.back().end(), copies, values[row]);
            }
            program.upload(part, (last - first) * copies, slice(data.constants, data.constants_per_row, first, last),
                           slice(data.records, data.records_per_row, first, last));
            program.enqueue();
            const auto out = program.read();
            program.save();
            for (std::size_t k = 0; k < out.size(); ++k)
                for (std::size_t row = 0; row < last - first; ++row) results[k].push_back(out[k][row * copies]);
        }
        return results;
    });
}

template std::vector<std::vector<float>> run_columns(const Device&, const ColumnKernel&,
                                                     const std::map<std::string, std::span<const float>>&, int,
                                                     const ColumnData&);
template std::vector<std::vector<double>> run_columns(const Device&, const ColumnKernel&,
                                                      const std::map<std::string, std::span<const double>>&, int,
                                                      const ColumnData&);

}  // namespace wrinkle
