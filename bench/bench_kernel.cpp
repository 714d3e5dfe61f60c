#include "bench_kernel.h"

#include <fstream>

#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

std::string text_of(const std::string& file) {
    std::ifstream in(WRINKLE_SOURCE_DIR "/bench/kernels/" + file);
    if (!in) throw Error("cannot read bench/kernels/" + file);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

BenchKernels::BenchKernels(const Device& device, const std::string& file, int lanes)
    : device_(device),
      lanes_(lanes == 0 ? device.info.lanes : lanes),
      built_(build_program(device, text_of(file), {lanes_, false})) {}

std::function<void()> BenchKernels::launcher(const std::string& kernel, const std::vector<cl::Buffer>& arguments,
                                             std::size_t pixels) const {
    cl::Kernel k(built_.program, kernel.c_str());
    cl_uint i = 0;
    for (const cl::Buffer& argument : arguments) k.setArg(i++, argument);
    k.setArg(i, static_cast<cl_uint>(pixels));
    const auto lanes = static_cast<std::size_t>(lanes_);
    const std::size_t items = ((pixels + lanes - 1) / lanes + 63) / 64 * 64;
    return [k, items, queue = device_.queue, arguments] {  // OpenCL kernels do not keep their buffers alive
        queue.enqueueNDRangeKernel(k, cl::NullRange, cl::NDRange(items), cl::NDRange(64));
        queue.finish();
    };
}

}  // namespace wrinkle::bench
