#include "budget/budget.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// Degrees by which rounding a unit vector's components to 16-bit floats may turn it: each by 2^-12 at most.
constexpr double kHalfRounding = 0.0243;

/// A variant helps where it brings the largest error below this share of what it was.
constexpr double kWorthIt = 0.9;

double largest(const ErrorStats& stats) {
    return stats.not_finite > 0 ? std::numeric_limits<double>::infinity() : stats.max;
}

}  // namespace

Budget::Budget(const Scene& scene, CameraKind camera, const DeviceCosts& costs)
    : scene_(scene), all_(wrinkle::choosables(scene, camera, costs)), allowed_(scene.budget.max_error.value()) {
    report_.max_error = allowed_;
    report_.costs = fmt::format("{} ({})", costs.device, costs.device_class);
    report_.seed = scene.budget.seed;
    if (scene.output.half) allowed_ -= kHalfRounding;
    if (allowed_ <= 0)
        throw Error(
            fmt::format("max_error = {} degrees is less than half = true rounds off ({}): write 32-bit floats, "
                        "or allow more",
                        report_.max_error, kHalfRounding));
    take(choose_precision(all_, scene.layers.size(), allowed_));
}

void Budget::take(const PrecisionChoice& choice) {
    choice_ = choice;
    report_.precision = describe(scene_, choice);
    report_.expected_ns = choice.ns, report_.expected_error = choice.error;
}

bool Budget::accept(const ErrorStats& measured) {
    if (largest(measured) > allowed_) return false;
    if (measured.max >= report_.measured.max) report_.measured = measured;
    return true;
}

void Budget::raise(const ErrorStats& missed, const std::function<ErrorStats(const PrecisionChoice&)>& measure) {
    const double before = largest(missed);
    if (choice_.fp64)
        throw Error(
            fmt::format("max_error = {} degrees cannot be kept: evaluated in double, the normals as they are "
                        "written are up to {:.2g} degrees off ({} of {} sampled ones not finite); allow more. "
                        "Nothing was written",
                        report_.max_error, missed.max, missed.not_finite, missed.samples));
    std::optional<PrecisionChoice> best;
    const Choosable* culprit = nullptr;
    double least = before * kWorthIt;
    for (const Choosable& what : all_) {
        const auto higher = raised(all_, choice_, what);
        if (!higher) continue;
        const double error = largest(measure(*higher));
        if (!(error < least)) continue;
        least = error, best = higher, culprit = &what;
        if (least <= allowed_) break;
    }
    std::string text = fmt::format("{}: {:.2g} degrees at most; ", report_.precision, before);
    if (best)
        text += fmt::format("{} did it: {:.2g} with its next variant", culprit->name, least);
    else
        text += "no layer's next variant helps: everything in double";
    report_.misses.push_back(text);
    take(best ? *best : all_in_double(all_));
}

}  // namespace wrinkle
