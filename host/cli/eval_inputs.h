#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/eval_arguments.h"
#include "io/csv_table.h"

namespace wrinkle::cli {

/// The rows to evaluate.
template <class T>
struct EvalInputs {
    std::map<std::string, std::vector<T>> columns;  ///< the columns of every parameter, by name
    std::vector<std::size_t> shape;                 ///< number of rows, or height and width of arrays and pictures
    std::optional<io::CsvTable> table;              ///< the CSV file, whose columns are written out again
};

/// Reads the columns of every parameter: from the array or picture that is given for it, else from the CSV file. When
/// no file is given at all, the CSV file is standard input. When other parameters are pictures, and x and y (in pixels)
/// are not given, they are the pixels' centres. T is float or double. Throws Error.
template <class T>
EvalInputs<T> read_inputs(const Function& function, const std::vector<EvalFile>& files);

/// A shape in words: "1080 x 1920".
std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace wrinkle::cli
