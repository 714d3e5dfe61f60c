#pragma once

#include "functions/tables.h"
#include "tests/cases/cases.h"

/// The errors of results, by the answers of the cases.
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

/// The error of a row, not yet divided by the row's allowance. Cases need an input n only for measures that use it.
inline real error_of(ErrorMeasure measure, const Cases& cases, const std::string& answer, V got, std::size_t row) {
    const V n = measure == ErrorMeasure::resolved_degrees ? cases.vec(row, "n") : V{};
    return error_of(measure, got, cases.want.at(answer)[row], n);
}

/// `components` columns of a row, beginning with `first`, as a vector. The other components are 0.
inline V value_at(const std::vector<std::vector<double>>& columns, std::size_t first, std::size_t components,
                  std::size_t row) {
    V v;
    real* const parts[] = {&v.x, &v.y, &v.z};
    for (std::size_t k = 0; k < components; ++k) *parts[k] = columns[first + k][row];
    return v;
}

/// The kernel of a variant. In double it normalises its normals first, as those of the cases are unit only to the
/// digits of a float.
inline ColumnKernel kernel_of(const Function& function, const FunctionVariant& variant, bool fp64) {
    ColumnKernel kernel = column_kernel(function, variant);
    if (fp64)
        for (const Parameter& parameter : function.parameters)
            if (parameter.unit_length)
                kernel.body = "    " + parameter.name + " = wr_normalize(" + parameter.name + ");\n" + kernel.body;
    return kernel;
}

}  // namespace wrinkle::cases
