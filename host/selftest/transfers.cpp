#include <fmt/format.h>

#include <cstring>

#include "device/guarded.h"
#include "selftest/checks.h"

namespace wrinkle::selftest {

namespace {

using Bytes = std::vector<unsigned char>;

Bytes some_bytes(std::size_t count, unsigned seed) {
    Bytes bytes(count);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<unsigned char>((i * 31 + i / 251 + seed) & 255);
    return bytes;
}

double differences(const Bytes& a, const Bytes& b) {
    double count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
    return count;
}

Bytes read(const Device& device, const cl::Buffer& buffer, std::size_t count) {
    Bytes bytes(count);
    device.queue.enqueueReadBuffer(buffer, CL_TRUE, 0, count, bytes.data());
    return bytes;
}

/// Writes all, then a part at an odd place, and reads both back.
double written_and_read(const Device& device, std::size_t count) {
    cl::Buffer buffer(device.context, CL_MEM_READ_WRITE, count);
    Bytes want = some_bytes(count, 1);
    device.queue.enqueueWriteBuffer(buffer, CL_TRUE, 0, count, want.data());
    const std::size_t first = count / 3, part = count / 2;
    if (part > 0) {
        const Bytes over = some_bytes(part, 99);
        device.queue.enqueueWriteBuffer(buffer, CL_TRUE, first, part, over.data());
        std::memcpy(want.data() + first, over.data(), part);
    }
    return differences(want, read(device, buffer, count));
}

double copied(const Device& device, std::size_t count) {
    const Bytes want = some_bytes(count, 2);
    cl::Buffer from(device.context, CL_MEM_READ_WRITE, count), to(device.context, CL_MEM_READ_WRITE, count);
    device.queue.enqueueWriteBuffer(from, CL_TRUE, 0, count, want.data());
    device.queue.enqueueCopyBuffer(from, to, 0, 0, count);
    return differences(want, read(device, to, count));
}

/// Written through one mapping, read through another.
double mapped(const Device& device, std::size_t count) {
    const Bytes want = some_bytes(count, 3);
    cl::Buffer buffer(device.context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, count);
    void* at = device.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_WRITE, 0, count);
    std::memcpy(at, want.data(), count);
    device.queue.enqueueUnmapMemObject(buffer, at);
    at = device.queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, 0, count);
    Bytes got(count);
    std::memcpy(got.data(), at, count);
    device.queue.enqueueUnmapMemObject(buffer, at);
    device.queue.finish();
    return differences(want, got);
}

}  // namespace

std::vector<Check> transfer_checks() {
    constexpr std::size_t kSizes[] = {1, 3, 64, 4097, 1000003};
    const auto check = [&](const char* what, double (*transfer)(const Device&, std::size_t)) {
        return Check{fmt::format("transfers, {}", what), [=](const Device& device) {
                         std::vector<Finding> findings;
                         for (const std::size_t size : kSizes)
                             findings.push_back({fmt::format("{} bytes", size), "bytes that differ",
                                                 guarded("moving bytes", [&] { return transfer(device, size); }), 0});
                         return findings;
                     }};
    };
    return {check("written and read", written_and_read), check("copied", copied), check("mapped", mapped)};
}

}  // namespace wrinkle::selftest
