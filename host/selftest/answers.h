#pragma once

#include <map>
#include <string>
#include <vector>

#include "functions/column_kernel.h"

/// Right answers that the program carries, so that a device can be checked where nothing else is there to compare with,
/// not even double precision. The references of tests/ computed them in long double, from the papers; tests/selftest/
/// writes answers.txt and compares it with them.
namespace wrinkle::selftest {

/// Inputs of a kernel function, or the name of a scene, with what should come out.
struct Answers {
    std::string name;                                    ///< of a function of functions(); "scene NAME"
    std::map<std::string, std::vector<float>> inputs{};  ///< by column, "n.x"; none for a scene, whose frame is made
    std::map<std::string, std::vector<double>> want{};   ///< by column of the results; NaN: any finite number will do
    std::vector<double> allowance{};                     ///< of each row, a factor on the documented bounds; empty: 1
    std::vector<double> angle_allowance{};               ///< the same of bounds in degrees; empty: as allowance
    ColumnData data{};  ///< what rows read beside their inputs: cameras, projectors, texels

    std::size_t rows() const { return want.empty() ? 0 : want.begin()->second.size(); }
};

/// Parses answers.txt: blocks, each a name on a line of its own and then "WHAT NAME NUMBERS" by the line. Throws Error
/// where it is none.
std::vector<Answers> parse_answers(const std::string& text);

/// Those that were there when the program was built.
const std::vector<Answers>& embedded_answers();

/// Throws Error where there are none of that name.
const Answers& answers_of(const std::string& name);

}  // namespace wrinkle::selftest
