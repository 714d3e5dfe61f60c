// Screen derivatives of the position, without neighbours: a ground plane up to its horizon, against the closed form.
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include "wrinkle/error.h"
#include "wrinkle/passes.h"

int main() try {
    // The ground z = 0 from 1.5 m above it, looking along +y; field of view 90 degrees. The ray of a pixel is
    // d = (X, 1, Y) with X, Y in [-1,1]; it meets the ground at depth t = -1.5 / Y, and the sky above the horizon.
    constexpr std::size_t n = 64, pixels = n * n;
    const double height = 1.5, step = 2.0 / n;
    const auto ray_x = [&](std::size_t i) { return (static_cast<double>(i % n) + 0.5) * step - 1; };
    const auto ray_y = [&](std::size_t i) { return 1 - (static_cast<double>(i / n) + 0.5) * step; };
    const auto camera = wrinkle::Camera::look_at({0, 0, height}, {0, 1, height}, {0, 0, 1}, std::acos(0.0), 1);
    std::vector<float> depth(pixels, std::numeric_limits<float>::infinity()), nx(pixels), ny(pixels), nz(pixels, 1);
    for (std::size_t i = pixels / 2; i < pixels; ++i) depth[i] = static_cast<float>(-height / ray_y(i));

    auto pass = wrinkle::screen_derivatives(
        wrinkle::Device::open(),
        {.size = {n, n}, .camera = camera, .planes = {"depth", "normal.x", "normal.y", "normal.z"}});
    std::vector<float> dx_x(pixels), dx_y(pixels), dx_z(pixels), dy_x(pixels), dy_y(pixels), dy_z(pixels);
    pass.run({{"depth", depth}, {"normal.x", nx}, {"normal.y", ny}, {"normal.z", nz}}, {{"dp_dx.x", dx_x},
                                                                                        {"dp_dx.y", dx_y},
                                                                                        {"dp_dx.z", dx_z},
                                                                                        {"dp_dy.x", dy_x},
                                                                                        {"dp_dy.y", dy_y},
                                                                                        {"dp_dy.z", dy_z}});

    // p = (t X, t, 0). One pixel to the right, X grows by `step`. One pixel down, Y shrinks by `step`, and so t shrinks
    // by t^2 step / height.
    int wrong = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const bool ground = i >= pixels / 2;  // the sky has no derivatives: zero
        const double t = ground ? -height / ray_y(i) : 0, dt = -t * t * step / height;
        const double error_x = std::hypot(dx_x[i] - t * step, dx_y[i], dx_z[i]);
        const double error_y = std::hypot(dy_x[i] - ray_x(i) * dt, dy_y[i] - dt, dy_z[i]);
        if (!(error_x <= 1e-4 * t * step && error_y <= 1e-4 * -dt)) ++wrong;
    }
    std::cout << wrong << " of " << pixels << " pixels wrong\n";
    return wrong == 0 ? 0 : 1;
} catch (const wrinkle::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
