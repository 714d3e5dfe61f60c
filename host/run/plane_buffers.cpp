#include "run/plane_buffers.h"

#include <algorithm>

namespace wrinkle {

namespace {

/// Memory of the host that the device copies from and to by itself. What is under way on the queue goes before it does.
std::shared_ptr<void> pinned_memory(const Device& device, const cl::CommandQueue& queue, std::size_t bytes) {
    const cl::Buffer buffer(device.context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR, bytes);
    return {queue.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ | CL_MAP_WRITE, 0, bytes),
            [queue, buffer](void* memory) {
                try {
                    queue.finish();
                    queue.enqueueUnmapMemObject(buffer, memory);
                    queue.finish();
                } catch (const cl::Error&) {
                    // the device is gone, and what it did with it
                }
            }};
}

}  // namespace

PlaneBuffers::PlaneBuffers(const Device& device, const std::vector<std::string>& names, std::size_t pixels,
                           std::size_t bytes_each)
    : PlaneBuffers(device, names, pixels, [=](const std::string&) { return bytes_each; }) {}

PlaneBuffers::PlaneBuffers(const Device& device, const std::vector<std::string>& names, std::size_t pixels,
                           const std::function<std::size_t(const std::string&)>& bytes_of)
    : queue_(device.context, device.device), pixels_(padded(pixels)), held_(pixels_) {
    const bool own = device.info.own_memory;
    for (const std::string& name : names) {
        const std::size_t bytes = pixels_ * bytes_of(name);
        planes_.emplace(name, cl::Buffer(device.context, CL_MEM_READ_WRITE | (own ? 0 : CL_MEM_ALLOC_HOST_PTR), bytes));
        if (own) host_[name] = {pinned_memory(device, queue_, bytes), bytes_of(name), {}};
    }
}

PlaneBuffers::~PlaneBuffers() {
    try {
        if (host_.empty()) unmap();
    } catch (const cl::Error&) {
        // the queue is gone, and the mapping with it
    }
}

std::size_t PlaneBuffers::travelling(const std::string& name) const {
    return std::min(held_, pixels_) * host_.at(name).pixel_bytes;
}

void* PlaneBuffers::memory(const std::string& name, cl_map_flags access) {
    const cl::Buffer& plane = planes_.at(name);
    if (!staged(name))
        return mapped_[name] =
                   queue_.enqueueMapBuffer(plane, CL_TRUE, access, 0, plane.getInfo<CL_MEM_SIZE>(), &ready_);
    const HostPlane& host = host_.at(name);
    if ((access & CL_MAP_WRITE) != 0) mapped_[name] = host.memory.get();
    if ((access & CL_MAP_READ) == 0) return host.memory.get();
    if (host.fetched() != nullptr)
        host.fetched.wait();
    else
        queue_.enqueueReadBuffer(plane, CL_TRUE, 0, travelling(name), host.memory.get(), &ready_);
    return host.memory.get();
}

void PlaneBuffers::unmap() {
    if (mapped_.empty()) return;
    ready_.clear();
    for (const auto& [name, memory] : mapped_) {
        const cl::Buffer& plane = planes_.at(name);
        cl::Event& given = ready_.emplace_back();
        if (staged(name))
            queue_.enqueueWriteBuffer(plane, CL_FALSE, 0, travelling(name), memory, nullptr, &given);
        else
            queue_.enqueueUnmapMemObject(plane, memory, nullptr, &given);
    }
    queue_.flush();  // commands of another queue wait for these
    mapped_.clear();
}

void PlaneBuffers::fetch(const std::vector<cl::Event>& done) {
    ready_ = done;
    if (host_.empty()) return;
    ready_.clear();
    for (auto& [name, host] : host_) {
        queue_.enqueueReadBuffer(planes_.at(name), CL_FALSE, 0, travelling(name), host.memory.get(), &done,
                                 &host.fetched);
        ready_.push_back(host.fetched);
    }
    queue_.flush();
}

}  // namespace wrinkle
