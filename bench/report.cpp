#include "report.h"

#include <fmt/format.h>

#include <fstream>

namespace wrinkle::bench {

namespace {

double ns_per_pixel(const Report& report, double seconds) {
    return seconds / (static_cast<double>(report.size.width) * report.size.height) * 1e9;
}

void print_rows(const Report& report, const std::vector<Row>& rows) {
    fmt::print("  {:<34}{:>10}{:>9}   {:>10}{:>10}{:>10}{:>7}\n", "", "ns/pixel", "spread", "median", "p99", "max",
               "inf");
    for (const Row& row : rows)
        fmt::print("  {:<34}{:>10.2f}{:>8.1f}%   {:>10.1e}{:>10.1e}{:>10.1e}{:>7}\n", row.name,
                   ns_per_pixel(report, row.seconds.median), 100 * row.seconds.spread, row.error.median, row.error.p99,
                   row.error.max, row.error.not_finite);
}

void print_ratio(const char* what, const Timing& slow, const Timing& fast) {
    const Ratio r = ratio(slow, fast);
    if (r.meaningful)
        fmt::print("  {:<58}{:>7.2f}x\n", what, r.value);
    else
        fmt::print("  {:<58}{:>8}\n", what, "not told apart: the spread is larger than the effect");
}

nlohmann::json rows_json(const Report& report, const std::vector<Row>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const Row& row : rows)
        list.push_back(
            {{"name", row.name},
             {"ns_per_pixel", ns_per_pixel(report, row.seconds.median)},
             {"spread", row.seconds.spread},
             {"error_degrees", {{"median", row.error.median}, {"p99", row.error.p99}, {"max", row.error.max}}},
             {"not_finite", row.error.not_finite},
             {"samples", row.error.samples}});
    return list;
}

}  // namespace

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

void print(const Report& report) {
    fmt::print("{}; {}; {} x {}; {} repetitions, medians; error in degrees against the double reference, {} pixels\n\n",
               report.processor, report.device, report.size.width, report.size.height, report.repetitions,
               report.rows.front().error.samples);
    fmt::print("the demo scene\n");
    print_rows(report, report.rows);
    print_ratio("plain C++ / fused", report.rows[1].seconds, report.rows[0].seconds);
    print_ratio("one kernel a layer / fused", report.rows[2].seconds, report.rows[0].seconds);
    fmt::print("\neach layer alone, above the empty scene\n");
    print_rows(report, report.layers);
    fmt::print("\nmemory\n");
    fmt::print("  {:<58}{:>7.1f} GB/s\n", "copy kernel", report.copy_gb_s);
    fmt::print("  {:<58}{:>7.1f} GB/s, {:.0f}% of copy\n", "resolve", report.resolve_gb_s,
               100 * report.resolve_gb_s / report.copy_gb_s);
    fmt::print("  {:<58}{:>7.1f} GB/s\n", "resolve in plain C++", report.baseline_resolve_gb_s);
    fmt::print("\nstart\n");
    fmt::print("  {:<58}{:>7.2f} s\n", "build, compiled, first call included", report.cold_build);
    fmt::print("  {:<58}{:>7.2f} s\n", "build, from the cache, first call included", report.warm_build);
    fmt::print("  {:<58}{:>7.3f} s\n", "warm `wrinkle run` outside reading, kernels, writing", report.run_outside);
}

nlohmann::json to_json(const Report& report) {
    return {{"processor", report.processor},
            {"device", report.device},
            {"width", report.size.width},
            {"height", report.size.height},
            {"repetitions", report.repetitions},
            {"scene", rows_json(report, report.rows)},
            {"layers", rows_json(report, report.layers)},
            {"copy_gb_per_s", report.copy_gb_s},
            {"resolve_gb_per_s", report.resolve_gb_s},
            {"baseline_resolve_gb_per_s", report.baseline_resolve_gb_s},
            {"cold_build_seconds", report.cold_build},
            {"warm_build_seconds", report.warm_build},
            {"warm_run_outside_seconds", report.run_outside}};
}

}  // namespace wrinkle::bench
