// Outputs that share memory with other planes are refused, wherever that memory comes from.
#include <gtest/gtest.h>

#include <array>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

std::string refusal(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) { return error.what(); }
    return "";
}

class SharedMemory : public testing::Test {
protected:
    const HostFrame frame_{plane_frame(test_camera(), {32, 16}, {0, 0, 1}), test_camera()};
    const std::size_t bytes_ = padded(frame_.count()) * sizeof(float);
    Pass pass_ = evaluate(device(), Scene{}, frame_.frame);

    cl::Buffer buffer(std::size_t bytes) const { return {device().context, CL_MEM_READ_WRITE, bytes}; }
    DevicePlanes separate(const std::vector<std::string>& names) const {
        DevicePlanes planes;
        for (const std::string& name : names) planes[name] = buffer(bytes_);
        return planes;
    }
    cl::Buffer part(cl::Buffer& whole, std::size_t first, std::size_t bytes) const {
        const cl_buffer_region region{first, bytes};
        return whole.createSubBuffer(CL_MEM_READ_WRITE, CL_BUFFER_CREATE_TYPE_REGION, &region);
    }
    void expect_refused(const DevicePlanes& in, const DevicePlanes& out, const char* other) {
        const std::string text = refusal([&] { pass_.enqueue(in, out).wait(); });
        EXPECT_NE(text.find("output plane \"normal.x\" shares memory"), std::string::npos) << text;
        EXPECT_NE(text.find(other), std::string::npos) << text;
    }
};

TEST_F(SharedMemory, OneBufferForTwoPlanes) {
    DevicePlanes in = separate(pass_.inputs()), out = separate(pass_.outputs());
    EXPECT_EQ(refusal([&] { pass_.enqueue(in, out).wait(); }), "");
    in["normal.x"] = out["normal.x"];
    expect_refused(in, out, "input plane \"normal.x\"");
    in = separate(pass_.inputs());
    in["normal.y"] = in["normal.x"];
    EXPECT_EQ(refusal([&] { pass_.enqueue(in, out).wait(); }), "") << "inputs may share";
    out["not a plane of the pass"] = in["normal.x"];
    EXPECT_EQ(refusal([&] { pass_.enqueue(in, out).wait(); }), "");
    out["normal.y"] = out["normal.x"];
    const std::string text = refusal([&] { pass_.enqueue(in, out).wait(); });
    EXPECT_NE(text.find("\"normal.y\" shares memory with the output plane \"normal.x\""), std::string::npos) << text;
}

TEST_F(SharedMemory, PartsOfOneBuffer) {
    const DevicePlanes in = separate(pass_.inputs());
    const std::size_t align = device().device.getInfo<CL_DEVICE_MEM_BASE_ADDR_ALIGN>() / 8;
    const std::size_t step = (bytes_ + align - 1) / align * align;
    cl::Buffer whole = buffer(3 * step);
    DevicePlanes given = in, out = separate(pass_.outputs());
    given["depth"] = part(whole, 0, step);
    out["normal.x"] = part(whole, step, step);
    EXPECT_EQ(refusal([&] { pass_.enqueue(given, out).wait(); }), "") << "side by side";
    out["normal.x"] = part(whole, step - align, step);
    expect_refused(given, out, "input plane \"depth\"");
    out["normal.x"] = whole;
    expect_refused(given, out, "input plane \"depth\"");
}

TEST_F(SharedMemory, MemoryLentToBuffers) {
    alignas(128) static std::array<float, 2 * 32 * 16> memory;
    const auto lent = [&](std::size_t first) {
        return cl::Buffer(device().context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes_, memory.data() + first);
    };
    DevicePlanes in = separate(pass_.inputs()), out = separate(pass_.outputs());
    in["depth"] = lent(0);
    out["normal.x"] = lent(32 * 16);
    EXPECT_EQ(refusal([&] { pass_.enqueue(in, out).wait(); }), "");
    out["normal.x"] = lent(32);
    expect_refused(in, out, "input plane \"depth\"");
}

TEST_F(SharedMemory, SpansOfTheHost) {
    std::vector<float> memory(4 * frame_.count());
    const auto span = [&](std::size_t first) { return std::span(memory).subspan(first, frame_.count()); };
    HostPlanes in = frame_.planes();
    HostOutputs out{{"normal.x", span(0)}, {"normal.y", span(frame_.count())}, {"normal.z", span(2 * frame_.count())}};
    EXPECT_EQ(refusal([&] { pass_.run(in, out); }), "");
    in["normal.x"] = span(frame_.count() / 2);
    EXPECT_NE(refusal([&] { pass_.run(in, out); }).find("input plane \"normal.x\""), std::string::npos);
    in = frame_.planes();
    out["normal.y"] = span(1);
    EXPECT_NE(refusal([&] { pass_.run(in, out); }).find("output plane \"normal.x\""), std::string::npos);
}

}  // namespace
}  // namespace wrinkle::test
