#include "functions/area_table.h"

#include <fmt/format.h>

#include "budget/cost_table.h"

namespace wrinkle {

std::string area_table() {
    const DeviceCosts costs = shipped_costs().at(0);
    std::string text =
        "\n## Over a pixel's area\n\n"
        "The errors above are those of arithmetic. What layers miss of the mean over the area that a pixel shows is "
        "more: "
        "degrees, median\nand 99% of pixels, by the largest number of points along the area (`[filter] taps`). "
        "Measured by `wrinkle tune data/scenes/*.toml`\non the scenes' frames, every layer by itself, of pixels that "
        "it tilts; "
        "of several of a kind the worst ([precision.json](precision.json)).\n\n"
        "| kind of layer | 1 point | 4 points | 16 points |\n|---|---|---|---|\n";
    for (const auto& [kind, rows] : costs.areas) {
        text += "| " + kind;
        for (const int taps : {1, 4, 16}) {
            const TapsCost& cost = rows.at(taps);
            text += fmt::format(" | {:.2g}, {:.2g}", cost.median, cost.p99);
        }
        text += " |\n";
    }
    return text;
}

}  // namespace wrinkle
