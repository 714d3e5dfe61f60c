#pragma once

#include <fmt/format.h>

#include <cmath>

#include "functions/tables.h"
#include "selftest/answers.h"
#include "selftest/scenes.h"
#include "tests/cases/registry.h"
#include "tests/run/run_frame.h"

/// What host/selftest/answers.txt holds: rows of the cases of every function, and scenes, answered by the references.
namespace wrinkle::test {

using selftest::Answers;

/// A few rows of a function's cases: of the regular and of the hard ones, evenly chosen, those whose inputs are finite.
inline std::vector<std::size_t> chosen_rows(const cases::Cases& cases, std::size_t of_each) {
    std::vector<std::size_t> chosen;
    for (const bool hard : {false, true}) {
        std::vector<std::size_t> there;
        for (std::size_t row = 0; row < cases.size(); ++row) {
            bool finite = true;
            for (const auto& [name, values] : cases.inputs) finite = finite && std::isfinite(values[row]);
            if (cases.hard[row] == hard && finite) there.push_back(row);
        }
        const std::size_t count = std::min(of_each, there.size());
        for (std::size_t k = 0; k < count; ++k) chosen.push_back(there[k * there.size() / count]);
    }
    return chosen;
}

/// Of numbers that come `per_row` each row (0: once for all), those of some rows.
inline std::vector<double> of_rows(const std::vector<double>& all, std::size_t per_row,
                                   const std::vector<std::size_t>& rows) {
    if (per_row == 0) return all;
    std::vector<double> some;
    for (const std::size_t row : rows)
        for (std::size_t k = 0; k < per_row; ++k) some.push_back(all[row * per_row + k]);
    return some;
}

inline Answers make_answers(const Function& function, std::size_t of_each) {
    const cases::Cases cases = cases::registry().at(function.name)();
    const std::vector<std::size_t> rows = chosen_rows(cases, of_each);
    Answers answers{.name = function.name};
    const auto pick = [&](const std::vector<cases::real>& from, std::vector<double>& to) {
        if (from.empty()) return;
        for (const std::size_t row : rows) to.push_back(static_cast<double>(from[row]));
        if (std::ranges::all_of(to, [](double v) { return v == 1; })) to.clear();
    };
    for (const auto& [name, values] : cases.inputs)
        for (const std::size_t row : rows) answers.inputs[name].push_back(values[row]);
    for (const Result& result : function.results) {
        const std::vector<std::string> columns = result.columns();
        for (const std::size_t row : rows) {
            const cases::V& want = cases.want.at(result.name)[row];
            const cases::real parts[] = {want.x, want.y, want.z};
            for (std::size_t k = 0; k < columns.size(); ++k)
                answers.want[columns[k]].push_back(static_cast<double>(parts[k]));
        }
    }
    pick(cases.allowance, answers.allowance);
    pick(cases.angle_allowance, answers.angle_allowance);
    answers.data = cases.data;
    answers.data.constants = of_rows(cases.data.constants, cases.data.constants_per_row, rows);
    answers.data.records = of_rows(cases.data.records, cases.data.records_per_row, rows);
    return answers;
}

/// Every function but those of volumes, whose grids are too large: a scene stands for them.
inline bool has_answers(const Function& function) { return function.file != "sources/volume.clh"; }

inline Answers make_answers(const selftest::CheckedScene& checked) {
    const selftest::CheckedFrame made = selftest::checked_frame();
    HostFrame frame;
    frame.frame = made.frame, frame.pixels = made.planes;
    const Truth truth(frame, checked.scene);
    Answers answers{.name = "scene " + checked.name};
    const auto put = [&](const std::string& name, const V& v) {
        const char* const parts = name == "lit" ? "rgb" : "xyz";
        const double values[] = {v.x, v.y, v.z};
        for (std::size_t k = 0; k < 3; ++k) answers.want[name + '.' + parts[k]].push_back(values[k]);
    };
    for (const auto& pixel : truth.pixels) put("normal", pixel.normal);
    for (const V& lit : truth.lit) put("lit", lit);
    return answers;
}

/// The text that parse_answers() reads. Numbers of inputs keep all digits of a float, answers 13.
inline std::string text_of(const Answers& answers) {
    std::string text = fmt::format("= {}\n", answers.name);
    const auto floats = [&](const std::string& head, const auto& values) {
        if (values.empty()) return;
        text += head;
        for (const auto value : values) text += fmt::format(" {}", static_cast<float>(value));
        text += '\n';
    };
    const auto doubles = [&](const std::string& head, const std::vector<double>& values) {
        if (values.empty()) return;
        text += head;
        for (const double value : values)
            text += std::isfinite(value) ? fmt::format(" {:.13g}", value) : std::string(" nan");
        text += '\n';
    };
    for (const auto& [name, values] : answers.inputs) floats("in " + name, values);
    for (const auto& [name, values] : answers.want) doubles("want " + name, values);
    doubles("allowance", answers.allowance);
    doubles("angle_allowance", answers.angle_allowance);
    floats(fmt::format("constants {}", answers.data.constants_per_row), answers.data.constants);
    floats(fmt::format("records {}", answers.data.records_per_row), answers.data.records);
    floats("texels", answers.data.texels);
    if (!answers.data.textures.empty()) text += fmt::format("textures {}\n", fmt::join(answers.data.textures, " "));
    return text;
}

}  // namespace wrinkle::test
