#include "run/band_pipeline.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace wrinkle {
namespace {

TEST(BandPipeline, EveryBandPassesEveryStageInOrder) {
    constexpr std::uint32_t in_flight = 4;
    for (const std::uint32_t bands : {0u, 1u, 3u, 200u}) {
        std::array<std::vector<std::uint32_t>, 3> seen;  // each is used by one stage only, so no lock is needed
        std::array<std::atomic<std::uint32_t>, 3> done{};
        const auto stage = [&](std::size_t s) {
            return [&, s](std::uint32_t band) {
                if (s == 0) {
                    EXPECT_LT(band, done[2] + in_flight) << "more in flight than there are places for";
                } else {
                    EXPECT_LT(band, done[s - 1]) << "before the stage before it";
                }
                seen[s].push_back(band);
                ++done[s];
            };
        };
        run_bands(bands, in_flight, {stage(0), stage(1), stage(2)});
        for (const auto& order : seen) {
            ASSERT_EQ(order.size(), bands);
            for (std::uint32_t band = 0; band < bands; ++band) EXPECT_EQ(order[band], band);
        }
    }
}

TEST(BandPipeline, StagesRunBesideEachOther) {
    // Band 1 is not evaluated before all bands have been read, and not written before all have been evaluated: this
    // ends only if stages run at the same time.
    std::atomic<std::uint32_t> read{0}, evaluated{0};
    const auto until = [](const auto& value, std::uint32_t least) {
        for (auto now = value.load(); now < least; now = value.load()) value.wait(now);
    };
    const auto add = [](auto& value) { ++value, value.notify_all(); };
    run_bands(3, 3,
              {.read = [&](std::uint32_t) { add(read); },
               .evaluate =
                   [&](std::uint32_t band) {
                       if (band == 1) until(read, 3);
                       add(evaluated);
                   },
               .write =
                   [&](std::uint32_t band) {
                       if (band == 1) until(evaluated, 3);
                   }});
    EXPECT_EQ(evaluated, 3u);
}

TEST(BandPipeline, ThrowsWhatAStageThrowsAndBeginsNothingMore) {
    for (std::size_t bad = 0; bad < 3; ++bad) {
        std::array<std::atomic<std::uint32_t>, 3> begun{};
        const auto stage = [&](std::size_t s) {
            return [&, s](std::uint32_t band) {
                ++begun[s];
                if (s == bad && band == 5) throw std::runtime_error("band 5");
            };
        };
        try {
            run_bands(100, 3, {stage(0), stage(1), stage(2)});
            ADD_FAILURE() << "stage " << bad << " failed and nobody said so";
        } catch (const std::runtime_error& error) { EXPECT_STREQ(error.what(), "band 5"); }
        EXPECT_EQ(begun[bad], 6u);
        EXPECT_LE(begun[0], 5u + 3u) << "no more than were in flight";
        for (std::size_t later = bad + 1; later < 3; ++later) EXPECT_LE(begun[later], 5u);
    }
}

}  // namespace
}  // namespace wrinkle
