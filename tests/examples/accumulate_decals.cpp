// Accumulates a decal on the caller's own OpenCL context, queue and buffers; events go in and come out.
#include <cmath>
#include <fstream>
#include <iostream>
#include <vector>

#include "wrinkle/error.h"
#include "wrinkle/passes.h"

int main() try {
    const cl::Device device = cl::Device::getDefault();
    const cl::Context context(device);
    const cl::CommandQueue queue(context, device);

    // The ground z = 0 seen straight down from 2 m, field of view 90 degrees: 4 m x 4 m, 32 pixels a metre.
    const wrinkle::Size size{128, 128};
    const std::size_t pixels = 128 * 128, bytes = wrinkle::padded(pixels) * sizeof(float);
    const auto camera = wrinkle::Camera::look_at({0, 0, 2}, {0, 0, 0}, {0, 1, 0}, std::acos(0.0), 1);

    // A height ramp of 6 texels over a box 1.2 m wide: each 0.2 m it rises by 51/255 of 0.5 m, so its slope is 0.5. The
    // image's s runs along axis_x, here world +y.
    std::ofstream("ramp.pgm") << "P2 6 2 255\n0 51 102 153 204 255\n0 51 102 153 204 255\n";
    wrinkle::DecalLayer box;
    box.texture = {.file = "ramp.pgm", .wrap = wrinkle::Wrap::clamp};
    box.axis_x = {0, 1, 0};
    box.axis_y = {-1, 0, 0};
    box.half_size = {0.6, 0.6, 0.6};
    box.falloff = 0;
    wrinkle::Layer decal;
    decal.name = "ramp";
    decal.bump = box;
    decal.scale = 0.5;

    const auto ours = wrinkle::Device::adopt(context, queue);
    auto pass = wrinkle::accumulate_decals(ours, {&decal, 1}, {.size = size, .camera = camera, .planes = {"depth"}});

    // Upload, evaluate and read back without blocking: each step waits for the events of the one before.
    const std::vector<float> depth(pixels, 2);
    const cl::Buffer depth_buffer(context, CL_MEM_READ_ONLY, bytes);
    wrinkle::DevicePlanes out;
    for (const std::string& name : pass.outputs()) out[name] = cl::Buffer(context, CL_MEM_READ_WRITE, bytes);
    cl::Event uploaded;
    queue.enqueueWriteBuffer(depth_buffer, CL_FALSE, 0, pixels * sizeof(float), depth.data(), nullptr, &uploaded);
    const std::vector<cl::Event> evaluated{pass.enqueue({{"depth", depth_buffer}}, out, {uploaded})};
    std::vector<float> x(pixels), y(pixels);
    std::vector<cl::Event> read(2);
    queue.enqueueReadBuffer(out.at("volume_gradient.x"), CL_FALSE, 0, pixels * 4, x.data(), &evaluated, &read[0]);
    queue.enqueueReadBuffer(out.at("volume_gradient.y"), CL_FALSE, 0, pixels * 4, y.data(), &evaluated, &read[1]);
    cl::Event::waitForEvents(read);

    // The volume gradient v is (0, 0.5, 0) between the ramp's inner texels and zero outside of the box. For any normal
    // n, the surface gradient is then g = v - n (n . v), and the bumped normal is normalize(n - g).
    int wrong = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const double east = std::abs((i % 128 + 0.5) / 32 - 2), north = std::abs(2 - (i / 128 + 0.5) / 32);
        const bool inside = east < 0.59 && north<0.29, outside = east> 0.61 || north > 0.61;
        if (inside && !(std::abs(x[i]) + std::abs(y[i] - 0.5f) < 1e-5f)) ++wrong;
        if (outside && (x[i] != 0 || y[i] != 0)) ++wrong;
    }
    std::cout << wrong << " of " << pixels << " pixels wrong\n";
    return wrong == 0 ? 0 : 1;
} catch (const std::exception& error) {  // wrinkle::Error, or cl::Error of the calls made here
    std::cerr << error.what() << '\n';
    return 1;
}
