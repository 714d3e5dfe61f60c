// A kernel of your own, own_kernel.cl, with what it reads filled in by wrinkle, on a frame that looks straight down.
// Checked against long double. Arguments: the folder of wrinkle's kernel files (wrinkle_KERNEL_DIR), and the kernel.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>

#include "wrinkle/device.h"
#include "wrinkle/resources.h"

using Real = long double;
constexpr std::size_t width = 64, height = 48, pixels = width * height, texels = 4;
const wrinkle::Vec3 eye{0.25, -0.5, 4}, half{0.75, 0.5, 0.5};
const wrinkle::Projector seal{.center{0.5, 0, 0}, .half_size = half, .scale = 0.1, .wrap = wrinkle::Wrap::repeat};

/// dh/ds (channel 0) or dh/dt of the image at (s, t), t up: bilinear, repeated.
Real slope(const std::vector<float>& image, std::size_t channel, Real s, Real t) {
    const Real x = s * texels - 0.5L, y = (1 - t) * texels - 0.5L;
    const auto at = [&](Real column, Real line) {
        const auto i = static_cast<long>(std::floor(column)) & 3, j = static_cast<long>(std::floor(line)) & 3;
        return static_cast<Real>(image.at(static_cast<std::size_t>(j * 4 + i) * 2 + channel));
    };
    const Real f = x - std::floor(x), upper = std::lerp(at(x, y), at(x + 1, y), f);
    return std::lerp(upper, std::lerp(at(x, y + 1), at(x + 1, y + 1), f), y - std::floor(y));
}

int main(int count, char** arguments) try {
    if (count != 3) return std::cerr << "usage: own_kernel KERNEL_DIR KERNEL_FILE\n", 1;
    std::vector<float> image, plane[4], out(3 * pixels);  // slopes; depth and normal of a rough ground
    for (std::size_t i = 0; i < 2 * texels * texels; ++i)
        image.push_back(static_cast<float>(std::sin(static_cast<double>(i * i))));
    for (std::size_t i = 0; i < pixels; ++i) {
        const double a = static_cast<double>(i), x = 0.3 * std::sin(0.1 * a), y = 0.3 * std::cos(0.07 * a);
        const double values[] = {4 + 0.2 * std::sin(0.03 * a), x, y, std::sqrt(1 - x * x - y * y)};
        for (int k = 0; k < 4; ++k) plane[k].push_back(static_cast<float>(values[k]));
    }
    const auto camera = wrinkle::Camera::look_at(eye, {eye[0], eye[1], 0}, {0, 1, 0}, 2 * std::atan(0.5), 4.0 / 3);
    const wrinkle::TextureUse use{.content = wrinkle::Content::slope, .unit = wrinkle::SlopeUnit::texture};
    const wrinkle::TextureSource map = wrinkle::ImageSource{use, wrinkle::ImageInMemory{texels, texels, 2, image}};
    wrinkle::TexelData data = wrinkle::texel_data({&map, 1});
    const auto row = wrinkle::projector_numbers(seal, {.texture = 0, .height = true}, wrinkle::eye_of(camera));
    const auto frame = wrinkle::camera_numbers(camera, {width, height});
    std::vector<float> projector(row.begin(), row.end()), wr_camera(frame.begin(), frame.end());

    auto on = wrinkle::Device::open();
    std::ifstream file(arguments[2]);
    cl::Program program(on.context, std::string(std::istreambuf_iterator<char>(file), {}));
    const std::string lanes = std::to_string(on.info.lanes), folder = arguments[1];
    program.build(("-cl-std=CL1.2 -D WR_LANES=" + lanes + " -I " + folder).c_str());
    cl::Kernel bump(program, "bump");
    std::vector<cl::Buffer> buffers;  // kernels do not keep their arguments alive
    const auto give = [&](auto& numbers) {
        buffers.emplace_back(on.queue, numbers.begin(), numbers.end(), false);
        bump.setArg(static_cast<cl_uint>(buffers.size() - 1), buffers.back());
    };
    give(wr_camera), give(projector), give(data.texels), give(data.textures);
    for (auto& numbers : plane) give(numbers);
    give(out);
    on.queue.enqueueNDRangeKernel(bump, {}, cl::NDRange(pixels / static_cast<std::size_t>(on.info.lanes)));
    cl::copy(on.queue, buffers.back(), out.begin(), out.end());

    Real worst = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const Real x = (i % width + 0.5L) / width - 0.5L, y = 0.5L - (i / width + 0.5L) / height, depth = plane[0][i];
        const Real p[] = {eye[0] + x * depth * 4 / 3, eye[1] + y * depth, eye[2] - depth};
        Real q[3], n[] = {plane[1][i], plane[2][i], plane[3][i]}, g[3] = {}, n_g = 0, square = 0;
        Real weight = std::clamp((n[2] - 0.25L) / 0.25L, 0.0L, 1.0L);
        for (std::size_t k = 0; k < 3; ++k)
            q[k] = (p[k] - seal.center[k]) / half[k], weight *= std::clamp((1 - std::abs(q[k])) / 0.1L, 0.0L, 1.0L);
        for (std::size_t k = 0; k < 2; ++k)  // dh/dp of the height map and of the decal
            n_g += n[k] * (g[k] = 0.03L * slope(image, k, p[0], p[1]) +
                                  weight * slope(image, k, (q[0] + 1) / 2, (q[1] + 1) / 2) * 0.1L / (2 * half[k]));
        for (int k = 0; k < 3; ++k) n[k] -= g[k] - n_g * n[k], square += n[k] * n[k];
        for (std::size_t k = 0; k < 3; ++k)
            worst = std::max(worst, std::abs(out[k * pixels + i] - n[k] / std::sqrt(square)));
    }
    std::cout << "largest error " << worst << '\n';
    return worst < 1e-6L ? 0 : 1;
} catch (const std::exception& error) { return std::cerr << error.what() << '\n', 1; }
