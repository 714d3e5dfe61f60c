// Devices that do not answer, and queues that cannot be adopted.
#include "device/found_device.h"

#include <gtest/gtest.h>

#include "tests/device/test_device.h"
#include "wrinkle/error.h"

namespace wrinkle::test {
namespace {

std::string failure(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) { return error.what(); }
    return "";
}

TEST(FoundDevice, SaysThatItDoesNotAnswer) {
    const std::string text = failure([] { describe_device(cl::Device()); });
    EXPECT_NE(text.find("OpenCL reports clGetDeviceInfo"), std::string::npos) << text;
}

TEST(FoundDevice, BrokenOnesAreLeftOut) {
    const std::vector<FoundDevice> found = describe_devices({cl::Device(), test_device().device, cl::Device()});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found.front().info.name, test_device().info.name);
    EXPECT_TRUE(describe_devices({cl::Device()}).empty());
}

TEST(Adopt, RefusesWhatItCannotWorkOn) {
    const cl::Device raw = test_device().device;
    const cl::Context context(raw), other(raw);
    const cl::CommandQueue queue(context, raw);
    EXPECT_EQ(failure([&] { Device::adopt(context, queue); }), "");
    EXPECT_NE(failure([&] { Device::adopt(other, queue); }).find("another context"), std::string::npos);
    EXPECT_NE(failure([&] { Device::adopt({}, queue); }).find("null"), std::string::npos);
    EXPECT_NE(failure([&] { Device::adopt(context, {}); }).find("null"), std::string::npos);
}

}  // namespace
}  // namespace wrinkle::test
