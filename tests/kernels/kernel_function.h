#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "device/program.h"
#include "tests/cases/cases.h"
#include "wrinkle/device.h"

/// Runs pieces of kernel language over columns of numbers, so that every concept function can be tested by itself.
namespace wrinkle::test {

using cases::Columns;

/// What is compiled. `body` sees each column under its name (a.x, a.y, a.z as vec3 a), `at`, the first row of the
/// work-item, and `rows`; `outputs` are expressions of type real.
struct KernelFunction {
    std::vector<std::string> includes;  ///< beside lanes, vec, constants and layout
    std::string body;
    std::vector<std::string> outputs;
};

struct Variant {
    int lanes = 8;
    bool fp64 = false;
};

/// What kernels read beside planes: `constants` and `records` are WR_SCALARs (wr_frame, wr_light; wr_decal ...). Where
/// the ..._per_row are set, each row has its own that many of them.
struct KernelData {
    std::vector<double> constants, records;
    std::size_t constants_per_row = 0, records_per_row = 0;
    std::vector<float> texels;
    std::vector<std::uint32_t> textures;
};

inline const Device& test_device() {
    static const Device device = [] {
        const std::string folder = (std::filesystem::temp_directory_path() / "wrinkle_test_cache").string();
        ::setenv("WRINKLE_CACHE_DIR", folder.c_str(), 0);
        return Device::open();
    }();
    return device;
}

constexpr std::size_t most_lanes = 16;

/// "a.x" as an identifier.
inline std::string column_identifier(std::string name) {
    for (char& c : name)
        if (c == '.') c = '_';
    return name;
}

inline std::string kernel_text(const KernelFunction& function, const Columns& columns, const KernelData& data) {
    std::string text;
    for (const char* file : {"lanes.clh", "vec.clh", "constants.clh", "layout.h"})
        text += fmt::format("#include \"{}\"\n", file);
    for (const std::string& file : function.includes) text += fmt::format("#include \"{}\"\n", file);
    text +=
        "#ifdef WR_FP64\n#define unit(n) wr_normalize(n)  // normals are only unit to the digits of a float\n"
        "#else\n#define unit(n) (n)\n#endif\n"
        "#define truth(m) ((m) ? (real)(1) : (real)(0))\n"
        "kernel void wr_test(global const float *restrict in, global WR_SCALAR *restrict out,\n"
        "    constant const WR_SCALAR *constants, global const WR_SCALAR *restrict records,\n"
        "    global const float *restrict texels, global const uint *restrict textures, uint stride, uint rows)\n{\n"
        "    size_t at = get_global_id(0) * WR_LANES;\n";
    if (data.constants_per_row + data.records_per_row > 0)
        text += fmt::format(
            "    size_t row = min(at, (size_t)(rows - 1)) / {};\n    constants += row * {}, records += row * {};\n",
            most_lanes, data.constants_per_row, data.records_per_row);
    int k = 0;
    for (const auto& [name, values] : columns) {
        const std::string id = column_identifier(name);
        text += fmt::format("    global const float *in_{0} = in + {1} * stride; real {0} = wr_load(in_{0}, at);\n", id,
                            k++);
        const std::string base = name.substr(0, name.find('.')), suffix = name.substr(base.size());
        if (suffix == ".z") text += fmt::format("    vec3 {0} = wr_v3({0}_x, {0}_y, {0}_z);\n", base);
        if (suffix == ".y" && !columns.contains(base + ".z"))
            text += fmt::format("    vec2 {0} = wr_v2({0}_x, {0}_y);\n", base);
    }
    text += function.body + "\n";
    for (std::size_t i = 0; i < function.outputs.size(); ++i)
        text += fmt::format("    wr_store({}, out + {} * stride, at);\n", function.outputs[i], i);
    return text + "}\n";
}

/// A buffer of `values` as the kernel's scalars.
inline cl::Buffer scalar_buffer(const Device& device, const std::vector<double>& values, bool fp64) {
    std::vector<double> wide = values.empty() ? std::vector<double>{0} : values;
    std::vector<float> narrow(wide.begin(), wide.end());
    return fp64 ? cl::Buffer(device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, wide.size() * 8, wide.data())
                : cl::Buffer(device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, narrow.size() * 4, narrow.data());
}

template <class T>
cl::Buffer plain_buffer(const Device& device, std::vector<T> values) {
    if (values.empty()) values.push_back(T{});
    return cl::Buffer(device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(T),
                      values.data());
}

template <class T>
std::vector<std::vector<double>> read_columns(const Device& device, const cl::Buffer& buffer, std::size_t columns,
                                              std::size_t stride, std::size_t rows) {
    std::vector<T> flat(columns * stride);
    device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, flat.size() * sizeof(T), flat.data());
    std::vector<std::vector<double>> out;
    for (std::size_t k = 0; k < columns; ++k) {
        const auto first = flat.begin() + static_cast<std::ptrdiff_t>(k * stride);
        out.emplace_back(first, first + static_cast<std::ptrdiff_t>(rows));
    }
    return out;
}

using Results = std::vector<std::vector<double>>;

/// One launch over all rows.
inline Results launch(const KernelFunction& function, const Columns& columns, Variant variant, const KernelData& data) {
    const Device& device = test_device();
    const BuiltProgram built =
        build_program(device, kernel_text(function, columns, data), {variant.lanes, variant.fp64});
    const std::size_t local = 16, rows = columns.begin()->second.size(), group = local * most_lanes;
    const std::size_t stride = (rows + group - 1) / group * group;
    std::vector<float> in;
    for (const auto& [name, values] : columns) {
        if (values.size() != rows) throw std::runtime_error("column " + name + " has another number of rows");
        in.insert(in.end(), values.begin(), values.end());
        in.insert(in.end(), stride - rows, values.back());
    }
    const std::size_t number = variant.fp64 ? sizeof(double) : sizeof(float);
    const cl::Buffer out(device.context, CL_MEM_WRITE_ONLY, function.outputs.size() * stride * number);
    cl::Kernel kernel(built.program, "wr_test");
    const cl::Buffer buffers[] = {plain_buffer(device, in),
                                  out,
                                  scalar_buffer(device, data.constants, variant.fp64),
                                  scalar_buffer(device, data.records, variant.fp64),
                                  plain_buffer(device, data.texels),
                                  plain_buffer(device, data.textures)};
    for (cl_uint i = 0; i < std::size(buffers); ++i) kernel.setArg(i, buffers[i]);
    kernel.setArg(6, static_cast<cl_uint>(stride));
    kernel.setArg(7, static_cast<cl_uint>(rows));
    device.queue.enqueueNDRangeKernel(kernel, {}, stride / static_cast<std::size_t>(variant.lanes), local);
    device.queue.finish();
    save_program(built);
    const auto read = variant.fp64 ? read_columns<double> : read_columns<float>;
    return read(device, out, function.outputs.size(), stride, rows);
}

/// One vector of numbers for each output. Rows with constants of their own fill a whole work-item each.
inline Results run_kernel(const KernelFunction& function, const Columns& columns, Variant variant,
                          const KernelData& data = {}) {
    if (data.constants_per_row + data.records_per_row == 0) return launch(function, columns, variant, data);
    const std::size_t rows = columns.begin()->second.size(), chunk = 64;  // constant buffers are small on some devices
    Results results(function.outputs.size());
    for (std::size_t first = 0; first < rows; first += chunk) {
        const std::size_t last = std::min(first + chunk, rows);
        const auto part = [&](const std::vector<double>& all, std::size_t per_row) {
            const auto at = [&](std::size_t row) { return all.begin() + static_cast<std::ptrdiff_t>(row * per_row); };
            return per_row == 0 ? all : std::vector<double>(at(first), at(last));
        };
        KernelData some = data;
        some.constants = part(data.constants, data.constants_per_row);
        some.records = part(data.records, data.records_per_row);
        Columns repeated;
        for (const auto& [name, values] : columns)
            for (std::size_t row = first; row < last; ++row)
                repeated[name].insert(repeated[name].end(), most_lanes, values[row]);
        const Results out = launch(function, repeated, variant, some);
        for (std::size_t k = 0; k < out.size(); ++k)
            for (std::size_t row = 0; row < last - first; ++row) results[k].push_back(out[k][row * most_lanes]);
    }
    return results;
}

}  // namespace wrinkle::test
