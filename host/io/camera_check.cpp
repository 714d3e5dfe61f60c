#include "io/camera_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "base/imath.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

using Row = std::array<double, 4>;

constexpr double kRounding = 1e-6;  // of the last row: products of float matrices
constexpr double kRigid = 1e-3;     // of lengths and cosines: float matrices printed with few digits

bool is_finite(const Mat4& m) {
    return std::ranges::all_of(
        m, [](const Row& row) { return std::ranges::all_of(row, [](double value) { return std::isfinite(value); }); });
}

/// Makes a last row that is 0 0 0 1 but for rounding just that; else false.
bool settle(Row& last) {
    const Row wanted{0, 0, 0, 1};
    for (std::size_t j = 0; j < 4; ++j)
        if (!(std::abs(last[j] - wanted[j]) <= kRounding)) return false;
    last = wanted;
    return true;
}

}  // namespace

std::string why_not_rigid(Mat4& view) {
    if (!settle(view[3])) {
        // Matrices written for row vectors are the usual slip.
        if (view[0][3] == 0 && view[1][3] == 0 && view[2][3] == 0 && view[3][3] == 1)
            return "is transposed: its translation is in the last row; it belongs in the last column";
        return fmt::format("must have the last row [0, 0, 0, 1]; found [{}]", fmt::join(view[3], ", "));
    }
    const auto axis = [&](int i) { return Imath::V3d(view[i][0], view[i][1], view[i][2]); };
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j)
            if (!(std::abs(axis(i).dot(axis(j)) - (i == j)) <= kRigid))
                return "must be rigid, world to camera: rows of its upper left 3x3 of unit length and at right angles";
    return {};
}

std::optional<Mat4> inverse_or_nothing(const Mat4& m) {
    try {
        return inverse(m);
    } catch (const Error&) { return std::nullopt; }
}

Camera checked_camera(Camera camera, const std::string& name) {
    if (!is_finite(camera.view)) throw Error(name + ": view holds a number that is not finite");
    if (!is_finite(camera.proj)) throw Error(name + ": proj holds a number that is not finite");
    if (const std::string why = why_not_rigid(camera.view); !why.empty())
        throw Error(fmt::format("{}: view {}", name, why));
    if (!inverse_or_nothing(camera.proj)) throw Error(name + ": proj is singular: it has no inverse");
    return camera;
}

}  // namespace wrinkle::io
