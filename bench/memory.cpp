#include <fstream>

#include "baseline/baseline.h"
#include "contenders.h"
#include "device/program.h"
#include "wrinkle/error.h"

namespace wrinkle::bench {

namespace {

std::string kernel_text() {
    std::ifstream in(WRINKLE_SOURCE_DIR "/bench/kernels/memory.cl");
    if (!in) throw Error("cannot read bench/kernels/memory.cl");
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void measure_memory(const Device& device, Report& report) {
    const std::size_t pixels = std::size_t{report.size.width} * report.size.height;
    const BuiltProgram built = build_program(device, kernel_text(), {device.info.lanes, false});
    const std::vector<std::string> names{"nx", "ny", "nz", "gx", "gy", "gz", "ox", "oy", "oz"};
    PlaneBuffers planes(device, names, pixels, sizeof(float));
    std::vector<std::vector<float>> host;
    for (const std::string& name : names) {
        float* p = planes.map<float>(name, CL_MAP_WRITE);
        const float value = name[0] == 'n' ? 0.57735027f : 0.01f * static_cast<float>(name[1] - 'w');
        std::fill(p, p + padded(pixels), value);
        host.emplace_back(pixels, value);
    }
    planes.unmap();

    cl::Kernel copy(built.program, "wr_copy"), resolve(built.program, "wr_resolve_only");
    const auto bind = [&](cl::Kernel& kernel, const std::vector<std::string>& arguments) {
        cl_uint i = 0;
        for (const std::string& name : arguments) kernel.setArg(i++, planes.planes().at(name));
        kernel.setArg(i, static_cast<cl_uint>(pixels));
    };
    bind(copy, {"nx", "ny", "nz", "ox", "oy", "oz"});
    bind(resolve, names);
    const auto lanes = static_cast<std::size_t>(device.info.lanes);
    const std::size_t items = ((pixels + lanes - 1) / lanes + 63) / 64 * 64;
    const auto run = [&](const cl::Kernel& kernel) {
        device.queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(64));
        device.queue.finish();
    };

    std::vector<Contender> contenders{
        {"copy", [&] { run(copy); }},
        {"resolve", [&] { run(resolve); }},
        {"resolve in plain C++", [&] {
             baseline::resolve({host[0], host[1], host[2]}, {host[3], host[4], host[5]}, {host[6], host[7], host[8]});
         }}};
    race(contenders, report.repetitions);
    const auto gb_s = [&](double bytes, const Timing& t) {
        return bytes * static_cast<double>(pixels) / t.median * 1e-9;
    };
    report.copy_gb_s = gb_s(24, contenders[0].seconds);
    report.resolve_gb_s = gb_s(36, contenders[1].seconds);
    report.baseline_resolve_gb_s = gb_s(36, contenders[2].seconds);
}

}  // namespace wrinkle::bench
