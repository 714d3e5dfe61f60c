#include "cli/explain_area.h"

#include <fmt/format.h>

#include "budget/cost_table.h"
#include "layers/kinds.h"

namespace wrinkle::cli {

namespace {

DeviceCosts costs_for(const std::optional<Device>& device) {
    return device ? costs_of(device->info) : shipped_costs().at(0);
}

/// A layer, and what its kind was measured to miss.
struct Expected {
    std::string layer, kind;
    std::optional<std::pair<int, TapsCost>> one, own;  ///< by one tap, and by the scene's, with the number measured
};

std::vector<Expected> expected(const Scene& scene, const DeviceCosts& costs) {
    std::vector<Expected> rows;
    for (const Layer& layer : scene.layers) {
        if (kind_of(layer_kinds(), layer).ends_stage) continue;
        const std::string kind = cost_kind(layer_kinds(), layer).name;
        const int taps = layer.footprint ? scene.filter.taps : 1;  // those that are not filtered have one point
        rows.push_back({layer.name, kind, costs.find_taps(kind, 1), costs.find_taps(kind, taps)});
    }
    return rows;
}

std::string degrees_text(const std::optional<std::pair<int, TapsCost>>& row) {
    return row ? fmt::format("{}: {:.2g}, {:.2g}", row->first, row->second.median, row->second.p99)
               : "not in the table";
}

nlohmann::json degrees_json(const std::optional<std::pair<int, TapsCost>>& row) {
    if (!row) return nullptr;
    return {{"taps", row->first}, {"median", row->second.median}, {"p99", row->second.p99}};
}

}  // namespace

void print_areas(const Scene& scene, const std::optional<Device>& device) {
    const DeviceCosts costs = costs_for(device);
    const std::vector<Expected> rows = expected(scene, costs);
    if (rows.empty()) return;
    fmt::print(
        "\nareas of pixels, with {} tap{} at most: degrees off, median and 99%, of each kind by itself on the scenes "
        "that\n"
        "the table of costs was measured on (\"wrinkle tune\"); \"wrinkle area {}\" measures this one\n"
        "  {:<34}{:<22}{:>18}{:>18}\n",
        scene.filter.taps, scene.filter.taps == 1 ? "" : "s", scene.file.string(), "layer", "kind", "one tap",
        "the scene's");
    for (const Expected& row : rows)
        fmt::print("  {:<34}{:<22}{:>18}{:>18}\n", row.layer, row.kind, degrees_text(row.one), degrees_text(row.own));
}

nlohmann::json areas_json(const Scene& scene, const std::optional<Device>& device) {
    const DeviceCosts costs = costs_for(device);
    nlohmann::json layers = nlohmann::json::array();
    for (const Expected& row : expected(scene, costs))
        layers.push_back({{"name", row.layer},
                          {"kind", row.kind},
                          {"one_tap", degrees_json(row.one)},
                          {"scene_taps", degrees_json(row.own)}});
    return {{"taps", scene.filter.taps}, {"degrees", layers}};
}

}  // namespace wrinkle::cli
