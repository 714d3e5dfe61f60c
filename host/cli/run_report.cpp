#include "cli/run_report.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/json_text.h"

namespace wrinkle::cli {

namespace {

const char* name_of(FrameReport::State state) {
    return state == FrameReport::State::written   ? "written"
           : state == FrameReport::State::skipped ? "skipped"
                                                  : "failed";
}

nlohmann::json names_of(const std::vector<std::filesystem::path>& files) {
    nlohmann::json names = nlohmann::json::array();
    for (const auto& file : files) names.push_back(file.string());
    return names;
}

/// "1:02:03", or "2:03".
std::string clock_time(double seconds) {
    const long whole = std::lround(seconds);
    const long hours = whole / 3600, minutes = whole / 60 % 60;
    return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                     : fmt::format("{}:{:02}", minutes, whole % 60);
}

void print_budget(const BudgetReport& budget) {
    for (const std::string& miss : budget.misses) fmt::print("missed by {}\n", miss);
    fmt::print("max_error {} degrees: {}\n", budget.max_error, budget.precision);
    fmt::print("  expected {:.2f} ns/pixel, {:.1e} degrees, by the table of {}\n", budget.expected_ns,
               budget.expected_error, budget.costs);
    fmt::print("  measured {:.1e} degrees (median), {:.1e} (99%), {:.1e} (largest) on {} pixels, seed {}\n\n",
               budget.measured.median, budget.measured.p99, budget.measured.max, budget.measured.samples, budget.seed);
}

void print_taps(const TapsChoice& choice) {
    fmt::print("max_area_error {} degrees: {} of at most {} taps\n", choice.max_area_error, choice.taps, choice.most);
    fmt::print("  measured {:.2g} degrees (median), {:.2g} (99%) on {} pixels, seed {}\n\n", choice.measured.median,
               choice.measured.p99, choice.measured.samples, choice.seed);
}

nlohmann::json json_of(const TapsChoice& choice) {
    return {{"max_area_error", choice.max_area_error},
            {"taps", choice.taps},
            {"most", choice.most},
            {"ns_per_pixel", choice.ns},
            {"measured",
             {{"median", choice.measured.median},
              {"p99", choice.measured.p99},
              {"max", choice.measured.max},
              {"pixels", choice.measured.samples}}},
            {"seed", choice.seed}};
}

nlohmann::json json_of(const BudgetReport& budget) {
    return {{"max_error", budget.max_error},
            {"precision", budget.precision},
            {"costs", budget.costs},
            {"expected", {{"ns_per_pixel", budget.expected_ns}, {"degrees", budget.expected_error}}},
            {"measured",
             {{"median", budget.measured.median},
              {"p99", budget.measured.p99},
              {"max", budget.measured.max},
              {"pixels", budget.measured.samples}}},
            {"seed", budget.seed},
            {"misses", budget.misses}};
}

}  // namespace

void FrameLines::operator()(const FrameReport& frame) {
    ++told_;
    if (frame.state == FrameReport::State::written) ++evaluated_, seconds_ += frame.seconds;
    // What was skipped took no time, and says nothing of what is left.
    std::optional<double> left;
    if (evaluated_ > 0) left = seconds_ / static_cast<double>(evaluated_) * static_cast<double>(frames_ - told_);
    if (json_) {
        fmt::print("{}\n", json_text(nlohmann::json{{"frame", frame.frame},
                                                    {"state", name_of(frame.state)},
                                                    {"seconds", frame.seconds},
                                                    {"seconds_left", left ? nlohmann::json(*left) : nlohmann::json()},
                                                    {"error", frame.error},
                                                    {"files", names_of(frame.files)}},
                                     -1));
        std::fflush(stdout);
        return;
    }
    fmt::print(stderr, "frame {} {} ({} of {}): {:.2f} s{}{}\n", frame.frame, name_of(frame.state), told_, frames_,
               frame.seconds, left && told_ < frames_ ? fmt::format(", {} left", clock_time(*left)) : "",
               frame.error.empty() ? "" : ": " + frame.error);
}

void print_table(const RenderReport& report) {
    const double megapixels = static_cast<double>(report.pixels) / 1e6;
    if (report.skipped > 0)
        fmt::print("{} frame{} there already, of the same files and options\n", report.skipped,
                   report.skipped == 1 ? "" : "s");
    if (report.frames == 0) return;
    fmt::print("{} frame{}, {:.2f} Mpixel, {} active layer{} on {} ({} lane{})\n", report.frames,
               report.frames == 1 ? "" : "s", megapixels, report.layers, report.layers == 1 ? "" : "s",
               report.device.name, report.device.lanes, report.device.lanes == 1 ? "" : "s");
    for (const std::string& camera : report.cameras) fmt::print("camera: {}\n", camera);
    if (!report.lights.empty()) fmt::print("lights: {}\n", report.lights);
    fmt::print("\n  {:<22}{:>10}\n", "phase", "seconds");
    fmt::print("  {:<22}{:>10.3f}\n", "read", report.read);
    fmt::print("  {:<22}{:>10.3f}\n", "upload (textures)", report.upload);
    fmt::print("  {:<22}{:>10.3f}\n", report.cache_hit ? "build (cache hit)" : "build (compiled)", report.build);
    fmt::print("  {:<22}{:>10.3f}   {:.2f} ns/pixel\n", "kernels", report.kernels, report.kernel_ns_per_pixel);
    if (report.budget || report.taps) fmt::print("  {:<22}{:>10.3f}\n", "check in double", report.check);
    fmt::print("  {:<22}{:>10.3f}\n", "write", report.write);
    fmt::print("  {:<22}{:>10.3f}   {:.3f} of it outside read, kernels, write\n", "wall (phases overlap)", report.wall,
               report.outside);
    fmt::print("  {:<22}{:>10.0f}\n\n", "peak memory, MiB", static_cast<double>(report.peak_memory) / (1 << 20));
    if (report.budget) print_budget(*report.budget);
    if (report.taps) print_taps(*report.taps);
    for (const auto& file : report.files) fmt::print("wrote {}\n", file.string());
}

void print_json(const RenderReport& report, bool one_line) {
    nlohmann::json failed = nlohmann::json::array();
    for (const FrameReport& frame : report.failed) failed.push_back({{"frame", frame.frame}, {"error", frame.error}});
    fmt::print("{}\n", json_text(nlohmann::json{{"frames", report.frames},
                                                {"skipped", report.skipped},
                                                {"failed", failed},
                                                {"pixels", report.pixels},
                                                {"layers", report.layers},
                                                {"device", report.device.name},
                                                {"lanes", report.device.lanes},
                                                {"cache_hit", report.cache_hit},
                                                {"seconds",
                                                 {{"read", report.read},
                                                  {"upload", report.upload},
                                                  {"build", report.build},
                                                  {"kernels", report.kernels},
                                                  {"check", report.check},
                                                  {"write", report.write},
                                                  {"wall", report.wall},
                                                  {"outside", report.outside}}},
                                                {"kernel_ns_per_pixel", report.kernel_ns_per_pixel},
                                                {"peak_memory_bytes", report.peak_memory},
                                                {"cameras", report.cameras},
                                                {"fitted_lights", report.lights},
                                                {"budget", report.budget ? json_of(*report.budget) : nlohmann::json()},
                                                {"taps", report.taps ? json_of(*report.taps) : nlohmann::json()},
                                                {"warnings", report.warnings},
                                                {"files", names_of(report.files)}},
                                 one_line ? -1 : 2));
}

}  // namespace wrinkle::cli
