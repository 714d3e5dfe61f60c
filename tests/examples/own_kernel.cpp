// A kernel of your own that uses wrinkle's kernel functions: a sine along x bumps the normal of a plane. It needs only
// OpenCL and the kernel files (wrinkle finds the device here, for brevity). Its argument is the folder of the kernel
// files, wrinkle_KERNEL_DIR of the CMake package.
#include <cmath>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "wrinkle/device.h"

constexpr char source[] = R"(
#include "lanes.clh"      // wr_real, wr_mask ...: WR_LANES pixels a work-item
#include "vec.clh"        // wr_vec2, wr_vec3
#include "constants.clh"
#include "surface/tangent_frame.clh"
#include "surface/surface_gradient.clh"
#include "compose/resolve.clh"

kernel void bump(global const float *restrict px, global float *restrict nx, global float *restrict nz)
{
    size_t at = get_global_id(0) * WR_LANES;
    wr_vec3 n = wr_v3((wr_real)(0), (wr_real)(0), (wr_real)(1));
    wr_vec3 dh_dp = wr_v3(cos(wr_load(px, at)), (wr_real)(0), (wr_real)(2));  // of the height sin(x) + 2 z
    wr_vec3 bumped = wr_resolve(n, wr_surface_gradient_from_volume(n, dh_dp));
    wr_store(bumped.x, nx, at);
    wr_store(bumped.z, nz, at);
}
)";

int main(int count, char** arguments) try {
    if (count != 2) throw std::runtime_error("usage: own_kernel KERNEL_DIR");
    auto on = wrinkle::Device::open();
    const int lanes = on.info.lanes;
    cl::Program program(on.context, source);
    const std::string options = "-cl-std=CL1.2 -D WR_LANES=" + std::to_string(lanes) + " -I " + arguments[1];
    try {
        program.build(on.device, options.c_str());
    } catch (const cl::Error&) { throw std::runtime_error(program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(on.device)); }

    std::vector<float> x(1024), nx(x.size()), nz(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = 0.01f * static_cast<float>(i);
    const std::size_t bytes = x.size() * sizeof(float);
    cl::Buffer in(on.context, CL_MEM_COPY_HOST_PTR, bytes, x.data()), out_x(on.context, 0, bytes),
        out_z(on.context, 0, bytes);
    cl::KernelFunctor<cl::Buffer, cl::Buffer, cl::Buffer> bump(program, "bump");
    bump(cl::EnqueueArgs(on.queue, cl::NDRange(x.size() / static_cast<std::size_t>(lanes))), in, out_x, out_z);
    on.queue.enqueueReadBuffer(out_x, CL_TRUE, 0, bytes, nx.data());
    on.queue.enqueueReadBuffer(out_z, CL_TRUE, 0, bytes, nz.data());

    // The height's part along the normal has no effect: normalize(-cos(x), 0, 1).
    int wrong = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double slope = std::cos(double{x[i]}), length = std::hypot(slope, 1.0);
        if (!(std::abs(nx[i] + slope / length) + std::abs(nz[i] - 1 / length) < 1e-6)) ++wrong;
    }
    std::cout << wrong << " of " << x.size() << " pixels wrong\n";
    return wrong == 0 ? 0 : 1;
} catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
}
