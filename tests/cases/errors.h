#pragma once

#include "functions/tables.h"
#include "tests/cases/cases.h"

/// How far results are from the answers of cases.
namespace wrinkle::cases {

inline real error_of(ErrorMeasure measure, V got, V want, V n) {
    switch (measure) {
        case ErrorMeasure::degrees:
            return is_zero(want) && is_zero(got) ? 0 : angle_degrees(got, want);
        case ErrorMeasure::relative:
            return relative_error(got, want);
        case ErrorMeasure::absolute:
            return length(got - want);
        case ErrorMeasure::resolved_degrees:
            return angle_degrees(normalize(n) - got, normalize(n) - want);
    }
    return 0;
}

/// The error of a row, without its allowance. `n` is only asked for where the measure needs it.
inline real error_of(ErrorMeasure measure, const Cases& cases, const std::string& answer, V got, std::size_t row) {
    const V n = measure == ErrorMeasure::resolved_degrees ? cases.vec(row, "n") : V{};
    return error_of(measure, got, cases.want.at(answer)[row], n);
}

/// The columns from `first` on as a vector; scalars and pairs in the first components.
inline V value_at(const std::vector<std::vector<double>>& columns, std::size_t first, std::size_t components,
                  std::size_t row) {
    V v;
    real* const parts[] = {&v.x, &v.y, &v.z};
    for (std::size_t k = 0; k < components; ++k) *parts[k] = columns[first + k][row];
    return v;
}

/// The kernel of a variant. In double, normals are made unit first: they are only unit to the digits of a float.
inline ColumnKernel kernel_of(const Function& function, const FunctionVariant& variant, bool fp64) {
    ColumnKernel kernel = column_kernel(function, variant);
    if (fp64)
        for (const Parameter& parameter : function.parameters)
            if (parameter.unit_length)
                kernel.body = "    " + parameter.name + " = wr_normalize(" + parameter.name + ");\n" + kernel.body;
    return kernel;
}

}  // namespace wrinkle::cases
