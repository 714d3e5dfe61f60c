#pragma once

#include "budget/cost_table.h"
#include "plan/plan.h"
#include "plan/precision.h"

namespace wrinkle {

/// How a scene is computed, and what the table expects of that.
struct PrecisionChoice {
    bool fp64 = false;  ///< all of it in double
    Precisions precision{};
    double ns = 0;     ///< a pixel
    double error = 0;  ///< degrees: the sum of the largest errors

    bool operator==(const PrecisionChoice& other) const { return fp64 == other.fp64 && precision == other.precision; }
};

/// Something that has variants: the geometry, or a layer.
struct Choosable {
    static constexpr std::size_t kGeometry = static_cast<std::size_t>(-1);
    std::size_t layer = kGeometry;
    std::string name;  ///< for messages
    struct Rung {
        Precision precision;
        VariantCost cost;
        bool measured;  ///< the table knows it
    };
    std::vector<Rung> ladder;  ///< costlier and more accurate from rung to rung
    Rung in_double;
};

/// What of the scene has variants, with costs of all its units; variants that cost more than a more accurate one are
/// left out. What was never measured costs and errs nothing: the sample shows what it does.
std::vector<Choosable> choosables(const Scene& scene, CameraKind camera, const DeviceCosts& costs);

/// The cheapest choice whose errors sum up to no more than `max_error`, by raising, one after another, what gains most
/// accuracy for its time; everything in double where nothing less will do or costs no less. A larger `max_error` never
/// gives a costlier choice.
PrecisionChoice choose_precision(const std::vector<Choosable>& all, std::size_t layers, double max_error);

/// The variant of a thing that a choice takes.
const Choosable::Rung& variant_in(const PrecisionChoice& choice, const Choosable& what);

/// The same choice with one thing a rung higher; nothing where it is on its last.
std::optional<PrecisionChoice> raised(const std::vector<Choosable>& all, const PrecisionChoice& from,
                                      const Choosable& what);

/// Everything in double.
PrecisionChoice all_in_double(const std::vector<Choosable>& all);

/// "standard; exact: \"dunes\", \"rock\"": what differs from standard.
std::string describe(const Scene& scene, const PrecisionChoice& choice);

}  // namespace wrinkle
