#pragma once

#include <memory>
#include <vector>

#include "cli/eval_inputs.h"

namespace wrinkle::cli {

template <class T>
using EvalResults = std::map<std::string, std::vector<T>>;  ///< by column

/// The files of --out. Throws Error for results that the function lacks and for formats there are not.
class EvalOutputs {
public:
    EvalOutputs(const Function& function, std::vector<EvalFile> files);

    /// The results that are written; all of them where there is a CSV file, or no file at all.
    std::vector<Result> results() const;

    /// Writes all files or none, or CSV on standard output where there is no file. T is float or double.
    template <class T>
    void write(const EvalInputs<T>& inputs, const EvalResults<T>& results) const;

private:
    const Function& function_;
    std::vector<EvalFile> files_;
};

}  // namespace wrinkle::cli
