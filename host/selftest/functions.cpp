#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec.h"
#include "functions/tables.h"
#include "selftest/answers.h"
#include "selftest/checks.h"
#include "selftest/errors.h"

namespace wrinkle::selftest {

namespace {

/// A number, pair or vector of a row; what it lacks is 0.
template <class Columns>
Vec3 value_at(const Columns& columns, const std::vector<std::string>& names, std::size_t row) {
    Vec3 value{};
    for (std::size_t k = 0; k < names.size(); ++k) value[k] = static_cast<double>(columns.at(names[k])[row]);
    return value;
}

double allowance(const Answers& answers, ErrorMeasure measure, std::size_t row) {
    const bool angle = measure == ErrorMeasure::degrees || measure == ErrorMeasure::resolved_degrees;
    const auto& factors = angle && !answers.angle_allowance.empty() ? answers.angle_allowance : answers.allowance;
    return factors.empty() ? 1 : factors[row];
}

std::vector<Finding> check_function(const Device& device, const Function& function, const FunctionVariant& variant) {
    const Answers& answers = answers_of(function.name);
    const std::map<std::string, std::span<const float>> inputs(answers.inputs.begin(), answers.inputs.end());
    const std::vector<std::vector<float>> results =
        run_columns<float>(device, column_kernel(function, variant), inputs, device.info.lanes, answers.data);
    std::map<std::string, std::vector<float>> got;
    std::size_t column = 0;
    for (const Result& result : function.results)
        for (const std::string& name : result.columns()) got[name] = results.at(column++);
    const bool flushes = (device.device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_DENORM) == 0;
    std::vector<Finding> findings;
    std::size_t bound = 0;
    for (const Result& result : function.results)
        for (const ErrorMeasure measure : result.measures) {
            Finding finding{result.name, unit_of(measure), 0, variant.max_errors.at(bound++)};
            for (std::size_t row = 0; row < answers.rows(); ++row) {
                const Vec3 is = value_at(got, result.columns(), row),
                           want = value_at(answers.want, result.columns(), row);
                const Vec3 n = measure == ErrorMeasure::resolved_degrees
                                   ? value_at(answers.inputs, {"n.x", "n.y", "n.z"}, row)
                                   : Vec3{};
                double error = 0;
                if (!is_finite(is))
                    error = std::numeric_limits<double>::quiet_NaN();
                else if (is_finite(want) && !(flushes && length(subtract(is, want)) < 4 * 0x1p-126))
                    error =
                        error_of(measure, is, want, n) / (variant.everywhere ? 1 : allowance(answers, measure, row));
                // NaN stays: a result that is not finite is not made good by those after it
                if (!std::isnan(finding.error) && !(error <= finding.error)) finding.error = error;
            }
            findings.push_back(finding);
        }
    return findings;
}

}  // namespace

std::vector<Check> function_checks(bool standard) {
    std::vector<Check> checks;
    for (const Function& function : functions()) {
        if (std::ranges::find(embedded_answers(), function.name, &Answers::name) == embedded_answers().end()) continue;
        for (const FunctionVariant& variant : function.variants)
            if ((variant.precision == Precision::standard) == standard)
                checks.push_back({fmt::format("function {}, {}", function.name, precision_name(variant.precision)),
                                  [&](const Device& device) { return check_function(device, function, variant); }});
    }
    return checks;
}

}  // namespace wrinkle::selftest
