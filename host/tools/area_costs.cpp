#include "tools/area_costs.h"

#include <fmt/format.h>

#include <algorithm>

#include "layers/kinds.h"
#include "wrinkle/error.h"

namespace wrinkle {

namespace {

/// The mean time and the largest errors of a row's layers so far, `count` of them, and another one.
TapsCost joined(const TapsCost& row, int count, const TapsError& one) {
    return {.ns = (row.ns * count + one.ns) / (count + 1),
            .median = std::max(row.median, one.degrees.median),
            .p99 = std::max(row.p99, one.degrees.p99)};
}

}  // namespace

std::map<std::string, std::map<int, TapsCost>> measure_area_costs(const std::vector<Scene>& scenes,
                                                                  const AreaOptions& options,
                                                                  const std::function<void(const std::string&)>& told) {
    std::map<std::string, std::map<int, TapsCost>> costs;
    std::map<std::string, int> layers;
    for (const Scene& scene : scenes)
        for (const Layer& layer : scene.layers) {
            if (kind_of(layer_kinds(), layer).ends_stage) continue;
            const std::string what = fmt::format("{}: layer \"{}\"", scene.file.filename().string(), layer.name);
            told(what + ", over areas");
            const std::string kind = cost_kind(layer_kinds(), layer).name;
            try {
                Scene alone = scene;
                alone.layers = {layer};
                const AreaErrors errors = measure_area(alone, options);
                for (const TapsError& one : errors.taps)
                    costs[kind][one.taps] = joined(costs[kind][one.taps], layers[kind], one);
                ++layers[kind];
            } catch (const Error& error) { told(fmt::format("{} is not measured over areas: {}", what, error.what())); }
        }
    return costs;
}

}  // namespace wrinkle
