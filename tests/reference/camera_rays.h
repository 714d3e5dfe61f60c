#pragma once

#include "tests/reference/screen_derivative.h"
#include "wrinkle/camera.h"

namespace wrinkle::reference {

/// A camera's geometry relative to its eye, from its matrices alone.
template <class T>
class CameraRays {
public:
    CameraRays(const Camera& camera, Size size) : width_(size.width), height_(size.height) {
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j) proj_[i][j] = camera.proj[i][j];
        const auto row = [&](int i) {
            return Vec<T>{T(camera.view[i][0]), T(camera.view[i][1]), T(camera.view[i][2])};
        };
        right_ = row(0), up_ = row(1), back_ = row(2);
        eye_ = -(right_ * T(camera.view[0][3]) + up_ * T(camera.view[1][3]) + back_ * T(camera.view[2][3]));
        const Mat4x4<T>& p = proj_;
        const auto zero = [](T a, T b, T c) { return a == 0 && b == 0 && c == 0; };
        pinhole_ = zero(p[0][3], p[1][3], p[3][3]) && p[3][0] == 0 && p[3][1] == 0 && p[3][2] != 0;
        parallel_ = zero(p[3][0], p[3][1], p[3][2]);
        if (pinhole_) {
            d0_ = at_depth(0, 0, 1);
            dx_ = at_depth(1, 0, 1) - d0_;
            dy_ = at_depth(0, 1, 1) - d0_;
        } else {
            const Mat4x4<T> rotation{{{right_.x, right_.y, right_.z, 0},
                                      {up_.x, up_.y, up_.z, 0},
                                      {back_.x, back_.y, back_.z, 0},
                                      {0, 0, 0, 1}}};
            const Mat4x4<T> to_clip{{{2 / width_, 0, 0, -1}, {0, -2 / height_, 0, 1}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
            from_screen_ = product(inverted(product(proj_, rotation)), to_clip);
        }
    }

    Vec<T> eye() const { return eye_; }  ///< world
    bool pinhole() const { return pinhole_; }
    bool parallel() const { return parallel_; }

    /// The eye-relative point that the pixel position (x, y) sees at view depth z: camera-space (a, b, -z) with
    /// clip.x = X clip.w and clip.y = Y clip.w, two linear equations in a and b.
    Vec<T> at_depth(T x, T y, T z) const {
        const T ndc_x = 2 * x / width_ - 1, ndc_y = 1 - 2 * y / height_;
        const auto equation = [&](int i, T ndc) {
            const auto c = [&](int j) { return proj_[i][j] - ndc * proj_[3][j]; };
            return Vec<T>{c(0), c(1), c(2) * z - c(3)};
        };
        const Vec<T> e = equation(0, ndc_x), f = equation(1, ndc_y);
        const T det = e.x * f.y - e.y * f.x;
        return right_ * ((e.z * f.y - e.y * f.z) / det) + up_ * ((e.x * f.z - e.z * f.x) / det) - back_ * z;
    }

    /// The eye-relative point at distance t from the eye of a pinhole camera.
    Vec<T> at_distance(T x, T y, T t) const { return normalize(at_depth(x, y, 1)) * t; }

    /// Unit vector from the point p that pixel (x, y) sees towards the viewer: to the eye, or under a parallel
    /// projection against the one direction of its rays.
    Vec<T> view(Vec<T> p, T x, T y) const {
        return parallel_ ? normalize(at_depth(x, y, 1) - at_depth(x, y, 2)) : normalize(-p);
    }

    /// dp/dx and dp/dy, per pixel to the right and down, on the plane through p (eye-relative) perpendicular to n. For
    /// a pinhole, the distance r in p = r d is found by least squares, as p may lie a little off the pixel's ray.
    ScreenDerivative<T> derivative(Vec<T> p, Vec<T> n, T x, T y) const {
        if (!pinhole_) return screen_derivative(p, n, from_screen_, x, y);
        const Vec<T> d = d0_ + dx_ * x + dy_ * y;
        return screen_derivative_pinhole(dot(p, d) / dot(d, d), n, d, dx_, dy_);
    }

private:
    T width_, height_;
    Mat4x4<T> proj_{}, from_screen_{};
    Vec<T> right_, up_, back_, eye_, d0_, dx_, dy_;
    bool pinhole_ = false, parallel_ = false;
};

}  // namespace wrinkle::reference
