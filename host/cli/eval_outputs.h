#pragma once

#include <memory>
#include <vector>

#include "cli/eval_inputs.h"

namespace wrinkle::cli {

template <class T>
using EvalResults = std::map<std::string, std::vector<T>>;  ///< by column

/// The files of --out. Throws Error when the function has no such result, or a file's format is not known.
class EvalOutputs {
public:
    EvalOutputs(const Function& function, std::vector<EvalFile> files);

    /// The results that have to be computed: those with a file; all of them when there is a CSV file or no file at all.
    std::vector<Result> results() const;

    /// Writes either all files or none. Without files, prints CSV. T is float or double.
    template <class T>
    void write(const EvalInputs<T>& inputs, const EvalResults<T>& results) const;

private:
    const Function& function_;
    std::vector<EvalFile> files_;
};

}  // namespace wrinkle::cli
