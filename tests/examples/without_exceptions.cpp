// A program whose OpenCL bindings came first, are for another version and throw nothing: the library still throws its
// own errors, and only them.
#define CL_HPP_TARGET_OPENCL_VERSION 300
#define CL_HPP_MINIMUM_OPENCL_VERSION 200
#include <CL/opencl.hpp>
#include <iostream>
#include <vector>

#include "wrinkle/error.h"
#include "wrinkle/functions.h"

int main() try {
    const cl::Context context(cl::Device::getDefault());
    const auto device = wrinkle::Device::adopt(context, cl::CommandQueue(context, cl::Device::getDefault()));
    const std::vector<float> zero(4), one(4, 1);
    std::vector<float> z(4);
    const wrinkle::Columns in{{"n.x", zero}, {"n.y", zero}, {"n.z", one}, {"g.x", zero}, {"g.y", zero}, {"g.z", zero}};
    wrinkle::evaluate_function(device, wrinkle::function("resolve"), in, {{"normal.z", z}});
    if (z != one) return 1;
    cl::Device nothing;
    if (nothing.getInfo<CL_DEVICE_NAME>() != "") return 1;  // the program's bindings, which say nothing of failures
    wrinkle::Device broken = device;
    broken.queue = cl::CommandQueue();
    try {
        wrinkle::evaluate_function(broken, wrinkle::function("resolve"), in, {{"normal.z", z}});
    } catch (const wrinkle::Error& error) {
        std::cout << "refused: " << error.what() << '\n';
        return 0;
    }
    std::cerr << "a queue that is none was used\n";
    return 1;
} catch (const std::exception& error) {
    std::cerr << "failed: " << error.what() << '\n';
    return 1;
}
