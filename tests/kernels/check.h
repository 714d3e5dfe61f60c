#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "tests/kernels/kernel_function.h"

/// Compares a kernel function with the answers of its cases, in every variant.
namespace wrinkle::test {

using cases::Cases;
using cases::real;
using cases::V;
using cases::V2;

/// Angle in degrees; relative vector error; absolute vector error; angle between the normals that the surface gradients
/// `got` and `want` resolve to.
enum class Metric { angle, relative, absolute, resolved };

/// One answer of a function: where it is, how its error is measured, how large it may be.
struct Answer {
    std::string name;                  ///< in Cases::want
    std::vector<std::string> outputs;  ///< expressions: components of the answer
    Metric metric = Metric::relative;
    double regular = 0, hard = 0;  ///< bounds of float runs
    double fp64 = 1e-12;           ///< bound of double runs
};

inline std::vector<std::string> xyz(const std::string& v) { return {v + ".x", v + ".y", v + ".z"}; }
inline std::vector<std::string> xy(const std::string& v) { return {v + ".x", v + ".y"}; }

inline real error_of(Metric metric, V got, V want, V n) {
    switch (metric) {
        case Metric::angle:
            return is_zero(want) && is_zero(got) ? 0 : angle_degrees(got, want);
        case Metric::relative:
            return relative_error(got, want);
        case Metric::absolute:
            return length(got - want);
        case Metric::resolved:
            return angle_degrees(normalize(n) - got, normalize(n) - want);
    }
    return 0;
}

/// Distance in units in the last place; two NaN or two equal infinities are 0 apart.
inline double ulps(double a, double b) {
    const float x = static_cast<float>(a), y = static_cast<float>(b);
    if (x == y || (std::isnan(x) && std::isnan(y))) return 0;
    const float size = std::max(std::abs(x), std::abs(y));
    return std::abs(a - b) / std::max(std::abs(double{std::nextafter(size, INFINITY)} - size), 1e-45);
}

inline std::string print(V v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", double(v.x), double(v.y), double(v.z)); }

class Checker {
public:
    Checker(const Cases& cases, std::vector<std::string> includes, std::string body, std::vector<Answer> answers,
            KernelData data = {})
        : cases_(cases), answers_(std::move(answers)), data_(std::move(data)) {
        function_ = {std::move(includes), std::move(body), {}};
        for (const Answer& answer : answers_)
            function_.outputs.insert(function_.outputs.end(), answer.outputs.begin(), answer.outputs.end());
    }

    /// Float on 8 lanes against the bounds, double against its own, other lanes against 8. `lane_ulps`: how far lanes
    /// may lie apart; compilers may round library functions differently on vectors.
    void run(double lane_ulps = 1) {
        ASSERT_GT(cases_.size(), 0u) << cases_.name;
        const auto eight = run_kernel(function_, cases_.inputs, {8, false}, data_);
        compare(eight, false);
        for (const int lanes : {1, 4, 16}) same(eight, lanes, lane_ulps);
        compare(run_kernel(function_, cases_.inputs, {4, true}, data_), true);
        compare(run_kernel(function_, cases_.inputs, {1, true}, data_), true);
    }

private:
    void fail(const std::string& text) {
        if (++failures_ <= 5) ADD_FAILURE() << text;
    }

    V value(const Results& results, std::size_t first, std::size_t components, std::size_t row) const {
        V v;
        real* const parts[] = {&v.x, &v.y, &v.z};
        for (std::size_t k = 0; k < components; ++k) *parts[k] = results[first + k][row];
        return v;
    }

    void compare(const Results& results, bool fp64) {
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
                const V n = answer.metric == Metric::resolved ? cases_.vec(row, "n") : V{};
                const real error = error_of(answer.metric, got, want[row], n) / cases_.allowance[row];
                if (!(error <= worst[hard])) worst[hard] = error, where[hard] = cases_.labels[row];
                const double bound = fp64 ? answer.fp64 : hard ? answer.hard : answer.regular;
                if (!(error <= bound))
                    fail(fmt::format("{}{}, {}: error {:.3g} of {:.3g} allowed, got {}, want {}", answer.name,
                                     fp64 ? " in double" : "", cases_.labels[row], double(error), bound, print(got),
                                     print(want[row])));
            }
            std::cout << fmt::format("[ measured ] {} {}{}: regular {:.2g}, hard {:.2g} {}\n", cases_.name, answer.name,
                                     fp64 ? " double" : "", double(worst[0]), double(worst[1]), where[1]);
            first += answer.outputs.size();
        }
    }

    void same(const Results& eight, int lanes, double allowed) {
        const Results other = run_kernel(function_, cases_.inputs, {lanes, false}, data_);
        for (std::size_t k = 0; k < eight.size(); ++k)
            for (std::size_t row = 0; row < cases_.size(); ++row)
                if (!(ulps(other[k][row], eight[k][row]) <= allowed))
                    fail(fmt::format("{} on {} lanes, {}: {:.9g}, on 8 lanes {:.9g}", function_.outputs[k], lanes,
                                     cases_.labels[row], other[k][row], eight[k][row]));
    }

    const Cases& cases_;
    std::vector<Answer> answers_;
    KernelData data_;
    KernelFunction function_;
    int failures_ = 0;
};

inline void check(const Cases& cases, std::vector<std::string> includes, std::string body, std::vector<Answer> answers,
                  KernelData data = {}, double lane_ulps = 1) {
    Checker(cases, std::move(includes), std::move(body), std::move(answers), std::move(data)).run(lane_ulps);
}

}  // namespace wrinkle::test
