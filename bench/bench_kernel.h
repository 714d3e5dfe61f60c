#pragma once

#include <functional>
#include <string>
#include <vector>

#include "device/program.h"
#include "wrinkle/device.h"

namespace wrinkle::bench {

/// The program of one file of bench/kernels. Its kernels take buffers, and the number of pixels as their last argument.
class BenchKernels {
public:
    /// `lanes` 0: the device's own. Throws Error when the file is missing or does not build.
    BenchKernels(const Device& device, const std::string& file, int lanes = 0);

    /// A call that runs the kernel over `pixels` and waits.
    std::function<void()> launcher(const std::string& kernel, const std::vector<cl::Buffer>& arguments,
                                   std::size_t pixels) const;

private:
    Device device_;
    int lanes_;
    BuiltProgram built_;
};

}  // namespace wrinkle::bench
