#include "camera_terms.h"

#include <cmath>
#include <utility>

#include "wrinkle/error.h"

namespace wrinkle::baseline {
namespace {

Mat4 product(const Mat4& a, const Mat4& b) {
    Mat4 out{};
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            for (int k = 0; k < 4; ++k) out[i][j] += a[i][k] * b[k][j];
    return out;
}

/// Gauss-Jordan with row pivots.
Mat4 inverted(Mat4 m) {
    Mat4 out{};
    for (int i = 0; i < 4; ++i) out[i][i] = 1;
    for (int column = 0; column < 4; ++column) {
        int pivot = column;
        for (int row = column + 1; row < 4; ++row)
            if (std::abs(m[row][column]) > std::abs(m[pivot][column])) pivot = row;
        if (m[pivot][column] == 0)
            throw Error("camera: view and proj have no inverse; give a camera that sees a volume");
        std::swap(m[pivot], m[column]);
        std::swap(out[pivot], out[column]);
        const double scale = 1 / m[column][column];
        for (int j = 0; j < 4; ++j) m[column][j] *= scale, out[column][j] *= scale;
        for (int row = 0; row < 4; ++row) {
            if (row == column) continue;
            const double factor = m[row][column];
            for (int j = 0; j < 4; ++j) m[row][j] -= factor * m[column][j], out[row][j] -= factor * out[column][j];
        }
    }
    return out;
}

/// View space to world space, directions only.
Vec3 to_world(const Mat4& view, Vec3 v) {
    Vec3 out{};
    for (int k = 0; k < 3; ++k) out[k] = view[0][k] * v[0] + view[1][k] * v[1] + view[2][k] * v[2];
    return out;
}

}  // namespace

CameraTerms camera_terms(const Camera& camera, Size size) {
    const Mat4& view = camera.view;
    const Mat4& proj = camera.proj;
    CameraTerms terms;
    terms.eye = to_float3(to_world(view, {-view[0][3], -view[1][3], -view[2][3]}));

    Mat4 rotation = view;
    for (int i = 0; i < 3; ++i) rotation[i][3] = 0;
    Mat4 screen{};  // pixels to NDC
    screen[0] = {2.0 / size.width, 0, 0, -1};
    screen[1] = {0, -2.0 / size.height, 0, 1};
    screen[2][2] = screen[3][3] = 1;
    const Mat4 m = product(inverted(product(proj, rotation)), screen);
    for (int i = 0; i < 4; ++i) {
        terms.columns[i] = {static_cast<float>(m[0][i]), static_cast<float>(m[1][i]), static_cast<float>(m[2][i]),
                            static_cast<float>(m[3][i])};
    }

    const double w = -proj[3][2];  // clip w of view depth 1
    const double det = proj[0][0] * proj[1][1] - proj[0][1] * proj[1][0];
    terms.pinhole = proj[3][0] == 0 && proj[3][1] == 0 && proj[3][3] == 0 && w > 0 && proj[0][3] == 0 &&
                    proj[1][3] == 0 && det != 0;
    if (!terms.pinhole) return terms;
    const auto on_plane = [&](double ndc_x, double ndc_y, double depth) {  // view space, from w * NDC
        const double a = w * ndc_x + depth * proj[0][2], b = w * ndc_y + depth * proj[1][2];
        return to_world(view,
                        {(proj[1][1] * a - proj[0][1] * b) / det, (proj[0][0] * b - proj[1][0] * a) / det, -depth});
    };
    terms.d0 = to_float3(on_plane(-1, 1, 1));
    terms.dx = to_float3(on_plane(2.0 / size.width, 0, 0));
    terms.dy = to_float3(on_plane(0, -2.0 / size.height, 0));
    return terms;
}

}  // namespace wrinkle::baseline
