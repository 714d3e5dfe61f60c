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
    std::map<std::string, std::vector<T>> columns;  ///< of every parameter
    std::vector<std::size_t> shape;                 ///< rows; or height, width ... of arrays and pictures
    std::optional<io::CsvTable> table;              ///< what passes through
};

/// Reads the columns of every parameter: from arrays and pictures where they are named, else from the CSV file, which
/// is standard input where no file is named at all. Parameters x and y in pixels are pixel centres unless given, where
/// others are pictures. T is float or double. Throws Error.
template <class T>
EvalInputs<T> read_inputs(const Function& function, const std::vector<EvalFile>& files);

/// "1080 x 1920"
std::string shape_text(const std::vector<std::size_t>& shape);

}  // namespace wrinkle::cli
