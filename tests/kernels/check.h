#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/kernels/kernel_function.h"
#include "wrinkle/functions.h"

/// Compares a kernel function with the answers of its cases, in every variant.
namespace wrinkle::test {

using cases::Cases;
using cases::real;
using cases::V;
using cases::V2;

/// One answer of a function: where it is, how its error is measured, how large it may be.
struct Answer {
    std::string name;                  ///< in Cases::want
    std::vector<std::string> outputs;  ///< expressions: components of the answer
    ErrorMeasure measure = ErrorMeasure::relative;
    double regular = 0, hard = 0;  ///< bounds of float runs
    double fp64 = 1e-12;           ///< bound of double runs
    bool everywhere = false;       ///< in float, without the allowances of the cases
};

inline std::vector<std::string> xyz(const std::string& v) { return {v + ".x", v + ".y", v + ".z"}; }
inline std::vector<std::string> xy(const std::string& v) { return {v + ".x", v + ".y"}; }

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

inline std::string print(V v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", double(v.x), double(v.y), double(v.z)); }

class Checker {
public:
    Checker(const Cases& cases, std::string body, std::vector<Answer> answers)
        : cases_(cases), answers_(std::move(answers)) {
        kernel_.body = std::move(body);
        for (const Answer& answer : answers_)
            kernel_.outputs.insert(kernel_.outputs.end(), answer.outputs.begin(), answer.outputs.end());
    }

    /// On every number of lanes against the bounds.
    void run() {
        ASSERT_GT(cases_.size(), 0u) << cases_.name;
        for (const int lanes : {1, 4, 8, 16}) compare({lanes, false});
        for (const int lanes : {1, 4}) compare({lanes, true});
    }

private:
    void fail(const std::string& text) {
        if (++failures_ <= 5) ADD_FAILURE() << text;
    }

    real allowance(const Answer& answer, bool fp64, std::size_t row) const {
        if (answer.everywhere && !fp64) return 1;
        const ErrorMeasure measure = answer.measure;
        const bool angle = measure == ErrorMeasure::degrees || measure == ErrorMeasure::resolved_degrees;
        return (angle && !cases_.angle_allowance.empty() ? cases_.angle_allowance : cases_.allowance)[row];
    }

    V value(const Results& results, std::size_t first, std::size_t components, std::size_t row) const {
        V v;
        real* const parts[] = {&v.x, &v.y, &v.z};
        for (std::size_t k = 0; k < components; ++k) *parts[k] = results[first + k][row];
        return v;
    }

    void compare(Variant variant) {
        const bool fp64 = variant.fp64;
        const Results results = run_kernel(kernel_, cases_.inputs, variant, cases_.data);
        std::size_t first = 0;
        for (const Answer& answer : answers_) {
            const std::vector<V>& want = cases_.want.at(answer.name);
            real worst[2] = {0, 0};
            std::string where[2];
            for (std::size_t row = 0; row < cases_.size(); ++row) {
                const V got = value(results, first, answer.outputs.size(), row);
                const bool hard = cases_.hard[row];
                if (!finite(got)) {
                    fail(fmt::format("{}, {}: not finite, {}, want {}", answer.name, cases_.labels[row], print(got),
                                     print(want[row])));
                    continue;
                }
                if (!finite(want[row])) continue;
                const V n = answer.measure == ErrorMeasure::resolved_degrees ? cases_.vec(row, "n") : V{};
                const real error = error_of(answer.measure, got, want[row], n) / allowance(answer, fp64, row);
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
    ColumnKernel kernel_;
    int failures_ = 0;
};

inline void check(const Cases& cases, std::string body, std::vector<Answer> answers) {
    Checker(cases, std::move(body), std::move(answers)).run();
}

}  // namespace wrinkle::test
