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

/// A part of a scene that can be computed in more than one precision: the geometry, or a layer.
struct Choosable {
    static constexpr std::size_t kGeometry = static_cast<std::size_t>(-1);
    std::size_t layer = kGeometry;
    std::string name;  ///< for messages
    /// A variant, and what the table says of it.
    struct Rung {
        Precision precision;
        VariantCost cost;
        bool measured;  ///< the table knows it
    };
    std::vector<Rung> ladder;  ///< costlier and more accurate from rung to rung
    Rung in_double;
};

/// The parts of the scene that have variants. Costs are those of the whole part: a unit's, times its units. Variants
/// that cost more than a more accurate one are left out. A variant that the table does not know counts as free and
/// exact; the sample that every run measures shows what it errs by.
std::vector<Choosable> choosables(const Scene& scene, CameraKind camera, const DeviceCosts& costs);

/// Begins with the cheapest variant of every part. While the errors sum up to more than `max_error`, the part that
/// loses most error for its extra time gets its next variant. Everything is computed in double where that is not
/// enough, or where double costs no more. A larger `max_error` never gives a costlier choice.
PrecisionChoice choose_precision(const std::vector<Choosable>& all, std::size_t layers, double max_error);

/// The variant that a choice takes of a part.
const Choosable::Rung& variant_in(const PrecisionChoice& choice, const Choosable& what);

/// The same choice with the next variant of one part; nothing where it takes the last one already.
std::optional<PrecisionChoice> raised(const std::vector<Choosable>& all, const PrecisionChoice& from,
                                      const Choosable& what);

/// Everything in double.
PrecisionChoice all_in_double(const std::vector<Choosable>& all);

/// "standard; exact: \"dunes\", \"rock\"": what differs from standard.
std::string describe(const Scene& scene, const PrecisionChoice& choice);

}  // namespace wrinkle
