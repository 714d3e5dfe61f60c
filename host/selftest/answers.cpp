#include "selftest/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "selftest/answer_text.h"
#include "wrinkle/error.h"

namespace wrinkle::selftest {

namespace {

template <class T>
std::vector<T> numbers(std::istringstream& line) {
    std::vector<T> all;
    // strtod, as streams do not read "nan".
    for (std::string word; line >> word;) all.push_back(static_cast<T>(std::strtod(word.c_str(), nullptr)));
    return all;
}

/// A line of a block. False where it begins none that is known.
bool add_line(Answers& answers, const std::string& what, std::istringstream& line) {
    std::string column;
    if (what == "in" && line >> column)
        answers.inputs[column] = numbers<float>(line);
    else if (what == "want" && line >> column)
        answers.want[column] = numbers<double>(line);
    else if (what == "allowance")
        answers.allowance = numbers<double>(line);
    else if (what == "angle_allowance")
        answers.angle_allowance = numbers<double>(line);
    else if (what == "constants" && line >> answers.data.constants_per_row)
        answers.data.constants = numbers<double>(line);
    else if (what == "records" && line >> answers.data.records_per_row)
        answers.data.records = numbers<double>(line);
    else if (what == "texels")
        answers.data.texels = numbers<float>(line);
    else if (what == "textures")
        answers.data.textures = numbers<std::uint32_t>(line);
    else
        return false;
    return true;
}

}  // namespace

std::vector<Answers> parse_answers(const std::string& text) {
    std::vector<Answers> all;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (line.starts_with("= ")) {
            all.push_back({.name = line.substr(2)});
            continue;
        }
        std::istringstream words(line);
        std::string what;
        if (!(words >> what)) continue;
        if (all.empty() || !add_line(all.back(), what, words))
            throw Error(fmt::format("answers.txt:{}: \"{}\" is no line of answers", number, line.substr(0, 40)));
    }
    return all;
}

const std::vector<Answers>& embedded_answers() {
    static const std::vector<Answers> all = parse_answers(answer_texts().front().text);
    return all;
}

const Answers& answers_of(const std::string& name) {
    const auto found = std::ranges::find(embedded_answers(), name, &Answers::name);
    if (found == embedded_answers().end()) throw Error(fmt::format("no answers for \"{}\" in answers.txt", name));
    return *found;
}

}  // namespace wrinkle::selftest
