#include "budget/choose_precision.h"

#include <fmt/format.h>

#include <algorithm>

#include "layers/kinds.h"

namespace wrinkle {

namespace {

/// Leaves out the variants that are no more accurate than a cheaper one.
std::vector<Choosable::Rung> worthwhile(std::vector<Choosable::Rung> rungs) {
    std::ranges::stable_sort(rungs, {}, [](const Choosable::Rung& rung) { return rung.cost.ns; });
    std::vector<Choosable::Rung> kept;
    for (const Choosable::Rung& rung : rungs)
        if (kept.empty() || (rung.cost.max < kept.back().cost.max && rung.precision > kept.back().precision))
            kept.push_back(rung);
    return kept;
}

Choosable choosable(const std::vector<Precision>& ladder, const CostKind& kind, const DeviceCosts& costs) {
    const auto rung = [&](Precision precision) {
        const std::optional<VariantCost> found = costs.find(kind.name, precision);
        VariantCost cost = found.value_or(VariantCost{});
        cost.ns *= kind.units;
        return Choosable::Rung{precision, cost, found.has_value()};
    };
    std::vector<Choosable::Rung> rungs;
    for (const Precision precision : ladder) rungs.push_back(rung(precision));
    return {.name = {}, .ladder = worthwhile(std::move(rungs)), .in_double = rung(Precision::fp64)};
}

Precision& precision_of(PrecisionChoice& choice, const Choosable& what) {
    return what.layer == Choosable::kGeometry ? choice.precision.geometry : choice.precision.layers[what.layer];
}

/// Which variant of the ladder a choice takes.
std::size_t rung_of(const Choosable& what, PrecisionChoice choice) {
    const Precision now = precision_of(choice, what);
    const auto found = std::ranges::find(what.ladder, now, &Choosable::Rung::precision);
    return static_cast<std::size_t>(found - what.ladder.begin());
}

/// Sets the time and the error that the table expects of a choice.
void sum_up(PrecisionChoice& choice, const std::vector<Choosable>& all) {
    choice.ns = choice.error = 0;
    for (const Choosable& what : all) {
        const VariantCost& cost = variant_in(choice, what).cost;
        choice.ns += cost.ns, choice.error += cost.max;
    }
}

}  // namespace

std::vector<Choosable> choosables(const Scene& scene, CameraKind camera, const DeviceCosts& costs) {
    std::vector<Choosable> all{choosable(geometry_precisions(), {kGeometryKind}, costs)};
    all.front().name = "the geometry";
    for (std::size_t i = 0; i < scene.layers.size(); ++i) {
        if (kind_of(layer_kinds(), scene.layers[i]).ends_stage) continue;
        all.push_back(choosable(layer_precisions(layer_kinds(), scene, i, camera),
                                cost_kind(layer_kinds(), scene.layers[i]), costs));
        all.back().layer = i;
        all.back().name = fmt::format("layer \"{}\"", scene.layers[i].name);
    }
    return all;
}

const Choosable::Rung& variant_in(const PrecisionChoice& choice, const Choosable& what) {
    return choice.fp64 ? what.in_double : what.ladder[rung_of(what, choice)];
}

PrecisionChoice all_in_double(const std::vector<Choosable>& all) {
    PrecisionChoice choice{.fp64 = true};
    for (const Choosable& what : all) choice.ns += what.in_double.cost.ns;
    return choice;
}

std::optional<PrecisionChoice> raised(const std::vector<Choosable>& all, const PrecisionChoice& from,
                                      const Choosable& what) {
    const std::size_t next = rung_of(what, from) + 1;
    if (from.fp64 || next >= what.ladder.size()) return std::nullopt;
    PrecisionChoice choice = from;
    precision_of(choice, what) = what.ladder[next].precision;
    sum_up(choice, all);
    return choice;
}

PrecisionChoice choose_precision(const std::vector<Choosable>& all, std::size_t layers, double max_error) {
    PrecisionChoice choice;
    choice.precision.layers.assign(layers, Precision::standard);
    for (const Choosable& what : all) precision_of(choice, what) = what.ladder.front().precision;
    sum_up(choice, all);
    const PrecisionChoice last = all_in_double(all);
    while (choice.error > max_error) {
        std::optional<PrecisionChoice> best;
        double most = -1;
        for (const Choosable& what : all) {
            const auto next = raised(all, choice, what);
            if (!next) continue;
            const double gain = (choice.error - next->error) / std::max(next->ns - choice.ns, 1e-6);
            if (gain > most) most = gain, best = next;
        }
        if (!best) return last;
        choice = *best;
    }
    return choice.ns < last.ns || last.ns == 0 ? choice : last;
}

std::string describe(const Scene& scene, const PrecisionChoice& choice) {
    if (choice.fp64) return "everything in double";
    std::string text = fmt::format("geometry {}", precision_name(choice.precision.geometry));
    std::string exact;
    for (std::size_t i = 0; i < choice.precision.layers.size(); ++i)
        if (choice.precision.layers[i] == Precision::exact)
            exact += fmt::format("{}\"{}\"", exact.empty() ? "" : ", ", scene.layers[i].name);
    return text + (exact.empty() ? ", layers standard" : ", layers standard but exact " + exact);
}

}  // namespace wrinkle
