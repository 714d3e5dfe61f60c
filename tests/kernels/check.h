#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>

#include "tests/cases/errors.h"
#include "tests/kernels/kernel_function.h"

/// Compares a kernel function with the answers of its cases, in every variant and on every number of lanes.
namespace wrinkle::test {

using cases::Cases;
using cases::real;
using cases::V;
using cases::V2;

/// One answer of a function: where to find it, how to measure its error, and how large the error may be.
struct Answer {
    std::string name;                  ///< its key in Cases::want
    std::vector<std::string> outputs;  ///< an expression for each component of the answer
    ErrorMeasure measure = ErrorMeasure::relative;
    double regular = 0, hard = 0;  ///< bounds of float runs
    double fp64 = 1e-12;           ///< bound of double runs
    bool everywhere = false;       ///< in float, the bounds hold without the allowances of the cases
};

inline std::vector<std::string> xyz(const std::string& v) { return {v + ".x", v + ".y", v + ".z"}; }
inline std::vector<std::string> xy(const std::string& v) { return {v + ".x", v + ".y"}; }

inline std::string print(V v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", double(v.x), double(v.y), double(v.z)); }

class Checker {
public:
    /// `body` returns the kernel's text.
    Checker(const Cases& cases, std::vector<Answer> answers, std::function<std::string(bool fp64)> body)
        : cases_(cases), answers_(std::move(answers)), body_(std::move(body)) {}

    /// Runs on every number of lanes and compares the errors with the bounds.
    void run() {
        ASSERT_GT(cases_.size(), 0u) << cases_.name;
        for (const int lanes : lanes_to_try()) compare({lanes, false});
        if (!test_device().info.fp64) return;
        for (const int lanes : lanes_to_try({1, 4})) compare({lanes, true});
    }

private:
    static constexpr real kLeastNormal = 0x1p-126L;

    /// Where denormal numbers become zero, as they may on a GPU, a result that is hardly larger has no digits to
    /// compare.
    static bool has_denormals() {
        return (test_device().device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_DENORM) != 0;
    }

    void fail(const std::string& text) {
        if (++failures_ <= 5) ADD_FAILURE() << text;
    }

    real allowance(const Answer& answer, bool fp64, std::size_t row) const {
        if (answer.everywhere && !fp64) return 1;
        const ErrorMeasure measure = answer.measure;
        const bool angle = measure == ErrorMeasure::degrees || measure == ErrorMeasure::resolved_degrees;
        return (angle && !cases_.angle_allowance.empty() ? cases_.angle_allowance : cases_.allowance)[row];
    }

    void compare(Variant variant) {
        const bool fp64 = variant.fp64;
        ColumnKernel kernel{body_(fp64), {}};
        for (const Answer& answer : answers_)
            kernel.outputs.insert(kernel.outputs.end(), answer.outputs.begin(), answer.outputs.end());
        const Results results = run_kernel(kernel, cases_.inputs, variant, cases_.data);
        const bool flushes = !fp64 && !has_denormals();
        std::size_t first = 0;
        for (const Answer& answer : answers_) {
            const std::vector<V>& want = cases_.want.at(answer.name);
            real worst[2] = {0, 0};
            std::string where[2];
            for (std::size_t row = 0; row < cases_.size(); ++row) {
                const V got = cases::value_at(results, first, answer.outputs.size(), row);
                const bool hard = cases_.hard[row];
                if (!finite(got)) {
                    fail(fmt::format("{}, {}: not finite, {}, want {}", answer.name, cases_.labels[row], print(got),
                                     print(want[row])));
                    continue;
                }
                if (!finite(want[row]) || (flushes && length(got - want[row]) < 4 * kLeastNormal)) continue;
                const real error =
                    cases::error_of(answer.measure, cases_, answer.name, got, row) / allowance(answer, fp64, row);
                if (!(error <= worst[hard])) worst[hard] = error, where[hard] = cases_.labels[row];
                const double bound = fp64 ? answer.fp64 : hard ? answer.hard : answer.regular;
                if (!(error <= bound))
                    fail(fmt::format("{}{} on {} lanes, {}: error {:.3g} of {:.3g} allowed, got {}, want {}",
                                     answer.name, fp64 ? " in double" : "", variant.lanes, cases_.labels[row],
                                     double(error), bound, print(got), print(want[row])));
            }
            std::cout << fmt::format("[ measured ] {} {}{}, {} lanes: regular {:.2g}, hard {:.2g} {}\n", cases_.name,
                                     answer.name, fp64 ? " double" : "", variant.lanes, double(worst[0]),
                                     double(worst[1]), where[1]);
            first += answer.outputs.size();
        }
    }

    const Cases& cases_;
    std::vector<Answer> answers_;
    std::function<std::string(bool)> body_;
    int failures_ = 0;
};

inline void check(const Cases& cases, const std::string& body, std::vector<Answer> answers) {
    Checker(cases, std::move(answers), [&](bool) { return body; }).run();
}

}  // namespace wrinkle::test
