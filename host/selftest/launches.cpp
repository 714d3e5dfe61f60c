#include <fmt/format.h>

#include <algorithm>

#include "device/guarded.h"
#include "device/program.h"
#include "device/work_group.h"
#include "functions/tables.h"
#include "selftest/answers.h"
#include "selftest/checks.h"

namespace wrinkle::selftest {

namespace {

constexpr std::size_t kRows = 4096, kLargest = 256;  // groups of passes have 64 items at most

/// resolve over rows, in groups of whatever size is asked for.
class Launch {
public:
    explicit Launch(const Device& device) : device_(device) {
        const Function& resolve = function("resolve");
        const Answers& answers = answers_of(resolve.name);
        const ColumnKernel kernel = column_kernel(resolve, resolve.variant(Precision::standard));
        std::vector<std::string> names;
        std::vector<float> in;
        for (const auto& [name, values] : answers.inputs) {
            names.push_back(name);
            for (std::size_t row = 0; row < kRows; ++row) in.push_back(values[row % values.size()]);
        }
        outputs_ = kernel.outputs.size();
        built_ = build_program(device, column_kernel_source(kernel, names, {}), {device.info.lanes, false});
        kernel_ = cl::Kernel(built_.program, "wr_columns");
        in_ = cl::Buffer(device.context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, in.size() * sizeof(float), in.data());
        out_ = cl::Buffer(device.context, CL_MEM_READ_WRITE, outputs_ * kRows * sizeof(float));
        nothing_ = cl::Buffer(device.context, CL_MEM_READ_ONLY, sizeof(float));  // those of constants have to be small
        kernel_.setArg(0, in_), kernel_.setArg(1, out_);
        for (cl_uint unused = 2; unused < 6; ++unused) kernel_.setArg(unused, nothing_);
        kernel_.setArg(6, static_cast<cl_uint>(kRows)), kernel_.setArg(7, static_cast<cl_uint>(kRows));
    }

    std::size_t largest_group() const { return work_group(device_, kernel_, std::min(kLargest, items())); }

    std::vector<float> run(std::size_t group) {
        std::vector<float> result(outputs_ * kRows, -77);
        device_.queue.enqueueWriteBuffer(out_, CL_TRUE, 0, result.size() * sizeof(float), result.data());
        device_.queue.enqueueNDRangeKernel(kernel_, {}, items(), cl::NDRange(group));
        device_.queue.enqueueReadBuffer(out_, CL_TRUE, 0, result.size() * sizeof(float), result.data());
        return result;
    }

private:
    std::size_t items() const { return kRows / static_cast<std::size_t>(device_.info.lanes); }

    Device device_;
    BuiltProgram built_;
    cl::Kernel kernel_;
    cl::Buffer in_, out_, nothing_;
    std::size_t outputs_ = 0;
};

}  // namespace

std::vector<Check> launch_checks() {
    return {{"work-groups of every size", [](const Device& device) {
                 return guarded("launching", [&] {
                     Launch launch(device);
                     const std::vector<float> want = launch.run(1);
                     std::vector<Finding> findings;
                     for (std::size_t size = 2; size <= launch.largest_group(); size *= 2) {
                         const std::vector<float> got = launch.run(size);
                         double differences = 0;
                         for (std::size_t i = 0; i < got.size(); ++i) differences += !(got[i] == want[i]);
                         findings.push_back({fmt::format("{} items", size), "numbers that differ", differences, 0});
                     }
                     return findings;
                 });
             }}};
}

std::vector<Check> all_checks() {
    std::vector<Check> all;
    for (const auto& some :
         {transfer_checks(), launch_checks(), function_checks(true), scene_checks(), function_checks(false)})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace wrinkle::selftest
