#include "cli/explain_budget.h"

#include <fmt/format.h>

namespace wrinkle::cli {

namespace {

/// The error of all choices together. In double it is smaller than what is rounded off when files are written, so no
/// sum is given.
std::string together(const Budget& budget) {
    return budget.choice().fp64 ? "what a file rounds off" : fmt::format("{:.1e}", budget.report().expected_error);
}

}  // namespace

void print_choice(const Budget& budget) {
    const BudgetReport& report = budget.report();
    fmt::print("\nmax_error {} degrees: {}\n", report.max_error, report.precision);
    fmt::print("  by the table of {}; a run measures, and takes more where that misses\n", report.costs);
    fmt::print("  {:<52}{:<10}{:>10}  {}\n", "what", "variant", "ns/pixel", "largest error, degrees");
    for (const Choosable& what : budget.choosables()) {
        const Choosable::Rung& variant = variant_in(budget.choice(), what);
        fmt::print("  {:<52}{:<10}", what.name, precision_name(variant.precision));
        if (variant.measured)
            fmt::print("{:>10.2f}  {:.1e}\n", variant.cost.ns, variant.cost.max);
        else
            fmt::print("{:>10}  {}\n", "-", "not in the table: counted as 0");
    }
    fmt::print("  {:<62}{:>10.2f}  {}\n", "together", report.expected_ns, together(budget));
}

nlohmann::json choice_json(const Budget& budget) {
    const BudgetReport& report = budget.report();
    nlohmann::json variants = nlohmann::json::array();
    for (const Choosable& what : budget.choosables()) {
        const Choosable::Rung& variant = variant_in(budget.choice(), what);
        nlohmann::json entry{{"name", what.name},
                             {"variant", precision_name(variant.precision)},
                             {"ns_per_pixel", nullptr},
                             {"degrees", nullptr}};
        if (variant.measured) entry["ns_per_pixel"] = variant.cost.ns, entry["degrees"] = variant.cost.max;
        variants.push_back(entry);
    }
    return {{"max_error", report.max_error},
            {"precision", report.precision},
            {"costs", report.costs},
            {"expected", {{"ns_per_pixel", report.expected_ns}, {"degrees", report.expected_error}}},
            {"variants", variants}};
}

}  // namespace wrinkle::cli
