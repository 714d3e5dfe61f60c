#pragma once

#include <map>
#include <random>
#include <string>
#include <vector>

#include "functions/column_kernel.h"
#include "tests/reference/golden.h"

/// Inputs of a kernel function with the right answers, for tests and benchmarks.
namespace wrinkle::cases {

using reference::GoldenTable;
using reference::real;
using reference::Vec;
using reference::Vec2;
using V = Vec<real>;
using V2 = Vec2<real>;

/// Columns of inputs by name: "n.x", "n.y" and "n.z" are the vector n of a kernel, "st.x" and "st.y" the pair st, "k" a
/// number.
using Columns = std::map<std::string, std::vector<float>>;

/// Rows of inputs, their answers in long double (numbers and pairs in the first components of a vector), and the rows'
/// labels for messages.
struct Cases {
    std::string name{};
    Columns inputs{};
    std::vector<std::string> labels{};
    std::vector<bool> hard{};
    std::map<std::string, std::vector<V>> want{};  ///< NaN or Inf: any finite answer will do
    std::vector<real> allowance{};  ///< for each row, a factor on the documented bounds; 1 unless its maker says why
    std::vector<real> angle_allowance{};  ///< the same for bounds in degrees; empty: as allowance
    ColumnData data{};                    ///< what rows read beside their inputs, such as a camera

    std::size_t size() const { return labels.size(); }

    void add(const std::string& label, bool is_hard, real factor = 1) {
        labels.push_back(label);
        hard.push_back(is_hard);
        allowance.push_back(factor);
    }
    void in(const std::string& column, real v) { inputs[column].push_back(static_cast<float>(v)); }
    void in(const std::string& column, V v) { in(column + ".x", v.x), in(column + ".y", v.y), in(column + ".z", v.z); }
    void in(const std::string& column, V2 v) { in(column + ".x", v.x), in(column + ".y", v.y); }
    void out(const std::string& answer, V v) { want[answer].push_back(v); }
    void out(const std::string& answer, V2 v) { want[answer].push_back({v.x, v.y, 0}); }
    void out(const std::string& answer, real v) { want[answer].push_back({v, 0, 0}); }

    /// "regular", or what makes a hard row hard. It is the first part of the row's label: of golden rows their
    /// category, of random ones the words before the seed.
    std::string category(std::size_t row) const {
        if (!hard[row]) return "regular";
        std::string text = labels[row];
        if (const auto golden = text.find(": hard/"); golden != std::string::npos) {
            text = text.substr(golden + 7);
            return text.substr(0, text.find(" case "));
        }
        return text.substr(0, text.find(", seed "));
    }

    V vec(std::size_t row, const std::string& column) const {
        const auto part = [&](const char* p) { return real{inputs.at(column + p)[row]}; };
        return {part(".x"), part(".y"), part(".z")};
    }
};

/// Adds row `row` of a golden table: its label and the vec3 inputs named.
inline void add_golden_row(Cases& cases, const GoldenTable& table, std::size_t row,
                           const std::vector<std::string>& vectors, real allowance = 1) {
    cases.add(cases.name + ": " + table.label(row), table.text(row, "set") == "hard", allowance);
    for (const std::string& v : vectors) cases.in(v, table.vec(row, v));
}

/// Random numbers that a float holds exactly, so that kernels and references get the same inputs.
class Random {
public:
    explicit Random(unsigned seed) : engine_(seed) {}

    real uniform(real low, real high) {
        return static_cast<float>(low + (high - low) * real(engine_() - engine_.min()) / real(engine_.max()));
    }
    int below(int n) { return static_cast<int>(engine_() % static_cast<unsigned>(n)); }
    /// 10 to the power of a random exponent.
    real magnitude(real low, real high) { return static_cast<float>(std::pow(10.0L, uniform(low, high))); }
    V box(real size) { return {uniform(-size, size), uniform(-size, size), uniform(-size, size)}; }
    /// A vector that is unit but for the rounding to float, as the normals of G-buffers are.
    V unit() {
        for (;;) {
            const V v = box(1);
            const real square = dot(v, v);
            if (square > 0.01L && square < 1) return rounded(normalize(v));
        }
    }
    static V rounded(V v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

private:
    std::mt19937 engine_;
};

}  // namespace wrinkle::cases
