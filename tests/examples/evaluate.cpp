// Evaluates a scene over a G-buffer in host memory: bumps one of the two objects on a ground plane.
#include <cmath>
#include <iostream>
#include <limits>
#include <vector>

#include "wrinkle/error.h"
#include "wrinkle/passes.h"

int main() try {
    // The ground z = 0 seen straight down from 2 m: depth 2 and normal +z everywhere. The right half is object 7, and
    // the first pixel is background.
    const wrinkle::Size size{64, 48};
    const std::size_t pixels = std::size_t{size.width} * size.height;
    std::vector<float> depth(pixels, 2), nx(pixels), ny(pixels), nz(pixels, 1), object(pixels);
    for (std::size_t i = 0; i < pixels; ++i) object[i] = i % size.width >= size.width / 2 ? 7 : 0;
    depth[0] = std::numeric_limits<float>::infinity();
    const auto camera = wrinkle::Camera::look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, 1.0, 64.0 / 48);

    // One layer: the same volume gradient everywhere on object 7. Its part along the normal, 5, has no effect.
    wrinkle::Layer ramp;
    ramp.name = "ramp";
    ramp.bump = wrinkle::ConstantLayer{{0.75, 0, 5}};
    ramp.mask.object = {7};
    wrinkle::Scene scene;
    scene.layers = {ramp};
    scene.output.marked = true;

    const auto device = wrinkle::Device::open();
    auto pass = wrinkle::evaluate(
        device, scene,
        {.size = size, .camera = camera, .planes = {"depth", "normal.x", "normal.y", "normal.z", "object"}});
    std::vector<float> out_x(pixels), out_y(pixels), out_z(pixels), marked(pixels);
    pass.run({{"depth", depth}, {"normal.x", nx}, {"normal.y", ny}, {"normal.z", nz}, {"object", object}},
             {{"normal.x", out_x}, {"normal.y", out_y}, {"normal.z", out_z}, {"marked", marked}});

    // normalize(n - g) with g = (0.75, 0, 0) is (-0.6, 0, 0.8).
    int wrong = marked[0] != wrinkle::Marked::invalid;
    for (std::size_t i = 1; i < pixels; ++i) {
        const float x = object[i] == 7 ? -0.6f : 0.0f, z = object[i] == 7 ? 0.8f : 1.0f;
        const float error = std::abs(out_x[i] - x) + std::abs(out_y[i]) + std::abs(out_z[i] - z);
        if (!(error < 1e-6f) || marked[i] != 0) ++wrong;
    }
    std::cout << wrong << " of " << pixels << " pixels wrong\n";
    return wrong == 0 ? 0 : 1;
} catch (const wrinkle::Error& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
