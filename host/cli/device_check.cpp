#include "cli/device_check.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "cli/json_text.h"
#include "selftest/scenes.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

using nlohmann::json;

constexpr std::chrono::seconds kTime{115};  // two minutes with what starting and ending takes

/// What has been said so far.
struct Report {
    json device, checks = json::array();
    std::string running;  ///< the check that has begun, and has not ended
    std::size_t next = 0, all = 0;
    std::chrono::milliseconds may_take{};  ///< of the running one
    std::vector<std::string> slow;         ///< ended because they took longer

    /// Takes what a check process said; true where a check has ended.
    bool take(const json& line) {
        if (line.contains("refused")) {
            if (next == 0) throw Error(line["refused"].get<std::string>());
            running = "the device, opened again";  // what was found before it went must not be lost
            add({{"failed", line["refused"]}});
            return true;
        }
        if (line.contains("device")) device = line["device"];
        if (line.contains("begins")) {
            running = line["begins"], next = line["number"].get<std::size_t>() + 1, all = line["of"];
            may_take = std::chrono::milliseconds(static_cast<long>(line["may_take"].get<double>() * 1000));
            return false;
        }
        if (!line.contains("seconds")) return false;
        add(line);
        return true;
    }

    void add(json check) {
        check["name"] = running;
        bool good = !check.contains("failed");
        if (check.contains("findings"))
            for (const json& finding : check["findings"]) good = good && finding["good"];
        check["good"] = good;
        checks.push_back(std::move(check));
        running.clear();
    }
};

std::string number(const json& value) {
    return value.is_null() ? "not finite" : fmt::format("{:.2g}", value.get<double>());
}

/// How near to its bound a finding is; what has none must be 0.
double share(const json& finding) {
    if (!finding["good"]) return std::numeric_limits<double>::infinity();
    const double bound = finding["bound"];
    return bound > 0 ? finding["error"].get<double>() / bound : 0;
}

/// Of a check that is in order the finding nearest to its bound, else all that are not.
std::string line_of(const json& check) {
    const std::string head =
        fmt::format("{:<6} {:<58}", check["good"] ? "ok" : "WRONG", check["name"].get<std::string>());
    if (check.contains("failed")) return fmt::format("{} {}\n", head, check["failed"].get<std::string>());
    const auto text = [&](const json& f) {
        return fmt::format("{} {}: {} {}, {} at most\n", head, f["what"].get<std::string>(), number(f["error"]),
                           f["unit"].get<std::string>(), number(f["bound"]));
    };
    std::string lines;
    const json* nearest = nullptr;
    for (const json& finding : check["findings"]) {
        if (!finding["good"]) lines += text(finding);
        if (nearest == nullptr || share(finding) > share(*nearest)) nearest = &finding;
    }
    return !lines.empty() || nearest == nullptr ? lines : text(*nearest);
}

std::string system_text() {
    utsname system{};
    ::uname(&system);
    return fmt::format("{} {} {}", system.sysname, system.release, system.machine);
}

void print_device(const json& d) {
    const auto text = [&](const char* key) { return d[key].get<std::string>(); };
    fmt::print("wrinkle {} on {}\n", WRINKLE_VERSION, system_text());
    fmt::print("{} ({}), driver {}\n", text("name"), text("type"), text("driver"));
    fmt::print("{}, {}; {}; {}\n", text("platform"), text("platform_version"), text("version"), text("language"));
    fmt::print(
        "{} compute units, {:.1f} GiB, {:.1f} GiB an allocation, groups of {} at most, {} memory, {} lanes, double: "
        "{}, "
        "denormal numbers: {}\n\n",
        d["compute_units"].get<unsigned>(), d["memory_bytes"].get<double>() / (1u << 30),
        d["largest_allocation_bytes"].get<double>() / (1u << 30), d["largest_group"].get<unsigned>(),
        d["own_memory"] ? "its own" : "the host's", d["lanes"].get<int>(), d["fp64"] ? "yes" : "no",
        d["denormals"] ? "yes" : "no");
    std::fflush(stdout);
}

/// Runs check processes until all is checked or the time is over. One that takes too long over a check is ended, and
/// the next begins after that check.
void run_checks(const WantedCheck& wanted, Report& report, const std::function<void()>& on_device,
                const std::function<void(const json&)>& on_check) {
    // What processes that are ended leave behind lies in here, and goes with it.
    const selftest::TemporaryFolder folder;
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    const auto end = CheckChild::Clock::now() + kTime;
    do {
        CheckChild child(wanted, report.next);
        std::string line;
        CheckChild::Said said;
        auto until = end;
        while ((said = child.next(line, until)) == CheckChild::Said::line) {
            const bool first = report.device.is_null();
            until = std::min(end, CheckChild::Clock::now() + std::chrono::seconds(30));  // until the first check begins
            if (report.take(json::parse(line))) on_check(report.checks.back());
            if (!report.running.empty()) until = std::min(end, CheckChild::Clock::now() + report.may_take);
            if (first) on_device();
        }
        if (said == CheckChild::Said::nothing) {
            if (report.device.is_null())
                throw Error(fmt::format("the driver did not open the device in {} s", kTime.count()));
            if (report.running.empty() || CheckChild::Clock::now() >= end) return;
            report.slow.push_back(std::exchange(report.running, {}));
            continue;
        }
        const std::optional<std::string> fate = child.fate();
        if (!fate && report.running.empty()) return;
        if (report.running.empty() && report.checks.empty())
            throw Error(fmt::format("the driver {} before anything was checked", fate.value_or("gave up")));
        const bool between = report.running.empty();
        if (between) report.running = "the driver, where nothing was checked";
        report.add({{"failed", "the driver " + fate.value_or("gave up")}});
        on_check(report.checks.back());
        if (between) return;
    } while (report.next < report.all);
}

}  // namespace

void check_device(const WantedCheck& wanted, bool as_json) {
    Report report;
    const auto nothing = [](auto&&...) {};
    if (as_json)
        run_checks(wanted, report, nothing, nothing);
    else
        run_checks(
            wanted, report, [&] { print_device(report.device); },
            [](const json& check) { fmt::print("{}", line_of(check)), std::fflush(stdout); });
    std::size_t wrong = 0;
    for (const json& check : report.checks) wrong += !check["good"];
    const std::size_t missing = report.all - std::min(report.all, report.checks.size());
    if (as_json)
        fmt::print("{}\n", json_text(json{{"wrinkle", WRINKLE_VERSION},
                                          {"system", system_text()},
                                          {"device", report.device},
                                          {"checks", report.checks},
                                          {"wrong", wrong},
                                          {"too_slow", report.slow},
                                          {"not_checked", missing}}));
    else {
        fmt::print("\n{} of {} checks are within their bounds, {} are not", report.checks.size() - wrong, report.all,
                   wrong);
        if (missing > report.slow.size())
            fmt::print("; there was no time for {}, but another run finds what this one built",
                       missing - report.slow.size());
        if (!report.slow.empty()) fmt::print("\nnot checked, as they take too long: {}", fmt::join(report.slow, "; "));
        fmt::print("\n");
    }
    if (report.checks.empty()) throw Error("no check came to its end, so nothing is known of the device");
    if (wrong > 0) throw Error(fmt::format("the device is out of bounds in {} of {} checks", wrong, report.all));
}

}  // namespace wrinkle::cli
