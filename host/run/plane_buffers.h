#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "wrinkle/passes.h"

namespace wrinkle {

/// Buffers for named planes in memory that host and device both reach: mapping them costs nothing on a CPU device and
/// is the fast way to copy on a GPU. They are mapped on a queue of their own, so that a long kernel on the device's
/// holds up nobody who reads or writes: who enqueues commands that use the planes has them wait for ready(), and who
/// maps has waited for those commands.
class PlaneBuffers {
public:
    PlaneBuffers() = default;
    PlaneBuffers(const Device& device, const std::vector<std::string>& names, std::size_t pixels,
                 std::size_t bytes_each)
        : PlaneBuffers(device, names, pixels, [=](const std::string&) { return bytes_each; }) {}
    /// `bytes_of` a pixel, by the plane's name.
    PlaneBuffers(const Device& device, const std::vector<std::string>& names, std::size_t pixels,
                 const std::function<std::size_t(const std::string&)>& bytes_of)
        : queue_(device.context, device.device) {
        for (const std::string& name : names)
            planes_.emplace(name, cl::Buffer(device.context, CL_MEM_READ_WRITE | CL_MEM_ALLOC_HOST_PTR,
                                             padded(pixels) * bytes_of(name)));
    }
    PlaneBuffers(const PlaneBuffers&) = delete;
    PlaneBuffers& operator=(const PlaneBuffers&) = delete;
    PlaneBuffers(PlaneBuffers&&) = default;
    PlaneBuffers& operator=(PlaneBuffers&&) = default;
    ~PlaneBuffers() {
        try {
            unmap();
        } catch (const cl::Error&) {
            // the queue is gone, and the mapping with it
        }
    }

    const DevicePlanes& planes() const { return planes_; }

    /// The plane's memory, until unmap(). Blocks.
    template <class T>
    T* map(const std::string& name, cl_map_flags access) {
        const cl::Buffer& plane = planes_.at(name);
        void* memory = queue_.enqueueMapBuffer(plane, CL_TRUE, access, 0, plane.getInfo<CL_MEM_SIZE>(), &ready_);
        mapped_[name] = memory;
        return static_cast<T*>(memory);
    }

    /// Gives all mapped planes back to the device; does not wait until it has them.
    void unmap() {
        if (mapped_.empty()) return;
        ready_.clear();
        for (const auto& [name, memory] : mapped_)
            queue_.enqueueUnmapMemObject(planes_.at(name), memory, nullptr, &ready_.emplace_back());
        queue_.flush();  // commands of another queue wait for these
        mapped_.clear();
    }

    /// The events after which the device has what was written to the planes.
    const std::vector<cl::Event>& ready() const { return ready_; }

private:
    cl::CommandQueue queue_;
    DevicePlanes planes_;
    std::map<std::string, void*> mapped_;
    std::vector<cl::Event> ready_;
};

/// What commands that use the planes of both wait for.
inline std::vector<cl::Event> both_ready(const PlaneBuffers& a, const PlaneBuffers& b) {
    std::vector<cl::Event> events = a.ready();
    events.insert(events.end(), b.ready().begin(), b.ready().end());
    return events;
}

}  // namespace wrinkle
