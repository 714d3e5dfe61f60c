#pragma once

#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] wrinkle {

/// fast: native functions or less compensation, with its own error; standard: what scenes use; exact: compensated
/// further; fp64: everything in double.
///
///     wrinkle::PassOptions careful;
///     careful.precision = {wrinkle::Precision::exact, {wrinkle::Precision::exact}};  // of one layer
///
/// Threads: values, used as any other.
enum class Precision { fast, standard, exact, fp64 };

/// "fast", "standard", "exact", "double".
std::string precision_name(Precision precision);

/// How exactly a pass in float computes: the geometry (positions, screen derivatives) and each layer. A precision that
/// something has no variant of is served by the next more accurate one it has, else by its most accurate one.
struct Precisions {
    Precision geometry = Precision::standard;
    std::vector<Precision> layers{};  ///< in the scene's order; empty: all standard
    bool operator==(const Precisions&) const = default;
};

}  // namespace wrinkle
