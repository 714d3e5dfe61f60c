#include "cli/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/names.h"

namespace wrinkle::cli {

namespace {

CLI::Validator number(const char* wanted, bool (*holds)(double)) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            double value = 0;
            if (CLI::detail::lexical_cast(text, value) && std::isfinite(value) && holds(value)) return {};
            return fmt::format("{} is given; expected {}", quote(text), wanted);
        },
        "");
}

}  // namespace

CLI::Validator finite() {
    return number("a finite number", [](double) { return true; });
}

CLI::Validator positive() {
    return number("a finite number greater than 0", [](double value) { return value > 0; });
}

CLI::Validator not_negative() {
    return number("a finite number, at least 0", [](double value) { return value >= 0; });
}

CLI::Validator zero_to_one() {
    return number("a number from 0 to 1", [](double value) { return value >= 0 && value <= 1; });
}

CLI::Validator one_of(const std::vector<std::string>& names) {
    return CLI::Validator(
        [=](std::string& text) -> std::string {
            if (std::ranges::find(names, text) != names.end()) return {};
            return fmt::format("{} is given{}; expected one of {}", quote(text), did_you_mean(text, names),
                               quote_list(names));
        },
        "");
}

}  // namespace wrinkle::cli
