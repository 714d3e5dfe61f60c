#include "bench/compare.h"

#include <gtest/gtest.h>

#include "bench/bars.h"
#include "tests/io/files.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {
namespace {

Measurement measurement(const char* name, double seconds, double p99) {
    Measurement m{.group = "function", .name = name, .variant = "standard", .lanes = 8, .pixels = 1000};
    m.seconds = {seconds, 0.02, {}};
    m.bytes = 36;
    m.error = {p99 / 4, p99, 2 * p99, 100, 0};
    return m;
}

Run run_of(std::vector<Measurement> measurements, double copy = 30) {
    Run run{"processor", "device", "bench", {9}, {copy, copy, 200, copy}, std::move(measurements), {}};
    return run;
}

/// What compare() prints, and what it returns: whether no error grew.
std::pair<std::string, bool> compared(const Run& before, const Run& now) {
    testing::internal::CaptureStdout();
    const bool kept = compare(before, now);
    std::fflush(stdout);
    return {testing::internal::GetCapturedStdout(), kept};
}

TEST(Compare, FlagsWhatBecameSlower) {
    const auto [text, kept] = compared(run_of({measurement("a", 1, 1e-5), measurement("b", 1, 1e-5)}),
                                       run_of({measurement("a", 1.3, 1e-5), measurement("b", 1.02, 1e-5)}));
    EXPECT_NE(text.find("slower             function/a/"), std::string::npos) << text;
    EXPECT_EQ(text.find("function/b/"), std::string::npos) << text;
    EXPECT_TRUE(kept);
}

TEST(Compare, FlagsWhatBecameLessAccurate) {
    const auto [text, kept] = compared(run_of({measurement("a", 1, 1e-5)}), run_of({measurement("a", 1, 2e-5)}));
    EXPECT_NE(text.find("LESS ACCURATE      function/a/"), std::string::npos) << text;
    EXPECT_FALSE(kept);
}

TEST(Compare, FlagsPeersThatComputeSomethingElse) {
    Measurement before = measurement("a", 1, 1e-5), now = measurement("a", 1, 3e-5);
    before.lanes = now.lanes = 0;
    EXPECT_TRUE(compared(run_of({before}), run_of({now})).second);
    now.error.median = 1;
    EXPECT_FALSE(compared(run_of({before}), run_of({now})).second);
}

TEST(Compare, FlagsHardInputsAndResultsThatAreNotFinite) {
    Measurement before = measurement("a", 1, 1e-5), now = before;
    before.hard["grazing"] = now.hard["grazing"] = {1e-6, 1e-5, 1e-5, 10, 0};
    EXPECT_TRUE(compared(run_of({before}), run_of({now})).second);
    now.hard["grazing"].max = 1e-3;
    EXPECT_FALSE(compared(run_of({before}), run_of({now})).second);
    now = before;
    now.error.not_finite = 1;
    EXPECT_FALSE(compared(run_of({before}), run_of({now})).second);
}

TEST(Compare, BlamesNoSlowerMachine) {
    const auto [text, kept] =
        compared(run_of({measurement("a", 1, 1e-5)}, 30), run_of({measurement("a", 2, 1e-5)}, 15));
    EXPECT_EQ(text.find("slower   "), std::string::npos) << text;
    EXPECT_TRUE(kept);
}

TEST(Record, ReadsBackWhatItWrote) {
    bench::Run run = run_of({measurement("a", 1, 1e-5)});
    run.measurements[0].hard["grazing"] = {1, 2, 3, 4, 5};
    run.measurements[0].memory = 1e6;
    run.rounds = {9, 2.5};
    run.bars = {{"a / b", "met", 0.5, 0.01, 0.85, 0.49, 0.52, true, "x", "y", 1e-5, 2e-5, "degrees"}};
    const test::TempFolder folder;
    const auto file = folder / "run.json";
    std::ofstream(file) << to_json(run).dump();
    EXPECT_EQ(to_json(read_run(file.string())), to_json(run));
    std::ofstream(file) << "{}";
    EXPECT_THROW(read_run(file.string()), Error);
}

TEST(Record, ReadsTheCommittedRuns) {
    std::size_t read = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(WRINKLE_SOURCE_DIR "/bench/results")) {
        if (entry.path().extension() != ".json") continue;
        EXPECT_FALSE(read_run(entry.path()).measurements.empty()) << entry.path();
        ++read;
    }
    EXPECT_GT(read, 0u);
}

}  // namespace
}  // namespace wrinkle::bench
