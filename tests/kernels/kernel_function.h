#pragma once

#include <fmt/format.h>

#include "functions/column_kernel.h"
#include "tests/cases/cases.h"
#include "tests/device/test_device.h"

/// Runs pieces of kernel text over columns of numbers, so that every kernel function can be tested by itself.
namespace wrinkle::test {

using cases::Columns;
using Results = std::vector<std::vector<double>>;

struct Variant {
    int lanes = 8;
    bool fp64 = false;
};

template <class T>
Results run_as(const ColumnKernel& kernel, const Columns& columns, int lanes, const ColumnData& data) {
    std::map<std::string, std::vector<T>> numbers;
    std::map<std::string, std::span<const T>> spans;
    for (const auto& [name, values] : columns)
        spans[name] = numbers[name] = std::vector<T>(values.begin(), values.end());
    Results results;
    for (const auto& column : run_columns<T>(test_device(), kernel, spans, lanes, data))
        results.emplace_back(column.begin(), column.end());
    return results;
}

/// Puts planes of at most 256 rows one after another into `texels`, which are float in double runs, too.
inline ColumnData float_planes(const std::vector<std::vector<float>>& planes) {
    ColumnData data;
    for (std::vector<float> plane : planes) {
        plane.resize(256);
        data.texels.insert(data.texels.end(), plane.begin(), plane.end());
    }
    return data;
}

/// Runs a kernel and gives a vector of numbers for each output. Its text may use unit(n), which normalises a normal in
/// double runs, and truth(m), which makes a mask a number.
inline Results run_kernel(ColumnKernel kernel, const Columns& columns, Variant variant, const ColumnData& data = {}) {
    kernel.body = (variant.fp64 ? "#define unit(n) wr_normalize(n)\n" : "#define unit(n) (n)\n") +
                  ("#define truth(m) ((m) ? (wr_real)(1) : (wr_real)(0))\n" + kernel.body);
    return variant.fp64 ? run_as<double>(kernel, columns, variant.lanes, data)
                        : run_as<float>(kernel, columns, variant.lanes, data);
}

}  // namespace wrinkle::test
