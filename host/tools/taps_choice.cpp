#include "tools/taps_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/area_error.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

constexpr int kMostPixels = 400;  // each is integrated at 1024 points

AreaOptions options_of(const Scene& scene, int frame, const std::string& device) {
    AreaOptions options{.taps = {}, .frame = frame, .device = device};
    for (int taps = 1; taps < scene.filter.taps; taps *= 2) options.taps.push_back(taps);
    options.taps.push_back(scene.filter.taps);
    options.sample = std::min(scene.budget.sample, kMostPixels);
    options.seed = scene.budget.seed;
    options.repeat = 1;
    return options;
}

}  // namespace

TapsChoice choose_taps(const Scene& scene, int frame, const std::string& device) {
    const double allowed = scene.budget.max_area_error.value();
    const AreaErrors errors = measure_area(scene, options_of(scene, frame, device));
    constexpr std::size_t fewest = 50;  // of fewer, 99% say nothing
    if (const auto measured = errors.taps.front().degrees.samples; measured < fewest)
        throw Error(
            fmt::format("max_area_error needs {} pixels of surfaces whose areas can be integrated, and the run's first "
                        "frame shows {} among those that were drawn; raise sample, begin with another frame, or set "
                        "[filter] taps instead",
                        fewest, measured));
    for (const TapsError& row : errors.taps)
        if (row.degrees.not_finite == 0 && row.degrees.p99 <= allowed)
            return {allowed, row.taps, scene.filter.taps, row.ns, row.degrees, scene.budget.seed};
    const TapsError& last = errors.taps.back();
    throw Error(
        fmt::format("max_area_error = {} degrees cannot be kept: with {} taps, 99% of {} sampled pixels are within "
                    "{:.2g} degrees of their areas; allow more{}. Nothing was written",
                    allowed, last.taps, last.degrees.samples, last.degrees.p99,
                    last.taps < 64 ? ", or give [filter] more taps (64 at most)" : ""));
}

}  // namespace wrinkle
