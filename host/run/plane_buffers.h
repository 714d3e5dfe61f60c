#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "wrinkle/passes.h"

namespace wrinkle {

/// Named planes that host and device take turns at.
///
/// Where the device's memory is the host's, both reach the same bytes: mapping costs nothing. A device with a memory of
/// its own has the planes there, and the host has its own in memory that the device copies from and to by itself
/// (CL_MEM_ALLOC_HOST_PTR, which drivers pin): unmap() starts an upload, fetch() a download, and neither waits.
///
/// Either happens on a queue of the planes' own, so that neither a long kernel on the device's holds up who reads or
/// writes, nor a transfer the kernels: who enqueues commands that use the planes has them wait for ready(), and who
/// maps has waited for those commands or called fetch().
class PlaneBuffers {
public:
    PlaneBuffers() = default;
    PlaneBuffers(const Device& device, const std::vector<std::string>& names, std::size_t pixels,
                 std::size_t bytes_each);
    /// `bytes_of` a pixel, by the plane's name.
    PlaneBuffers(const Device& device, const std::vector<std::string>& names, std::size_t pixels,
                 const std::function<std::size_t(const std::string&)>& bytes_of);
    PlaneBuffers(const PlaneBuffers&) = delete;
    PlaneBuffers& operator=(const PlaneBuffers&) = delete;
    PlaneBuffers(PlaneBuffers&&) = default;
    PlaneBuffers& operator=(PlaneBuffers&&) = default;
    ~PlaneBuffers();

    const DevicePlanes& planes() const { return planes_; }

    /// From now on only that many pixels of each plane travel; all, until it is called.
    void hold(std::size_t pixels) { held_ = pixels; }

    /// The plane's memory, until unmap(): with CL_MAP_READ it holds what the device has, or had when fetch() was last
    /// called, if ever; with CL_MAP_WRITE the device gets what is written there. Blocks.
    template <class T>
    T* map(const std::string& name, cl_map_flags access) {
        return static_cast<T*>(memory(name, access));
    }

    /// What the host wrote to a plane that no kernel writes to; until unmap(), costs no transfer.
    template <class T>
    const T* written(const std::string& name) {
        return static_cast<const T*>(staged(name) ? host_.at(name).memory.get() : memory(name, CL_MAP_READ));
    }

    /// Gives all mapped planes back to the device; does not wait until it has them.
    void unmap();

    /// Brings all planes to the host once these events have happened, of commands that waited for ready() and that are
    /// flushed; does not wait.
    void fetch(const std::vector<cl::Event>& done);

    /// The events after which the planes are the device's, with what was written to them.
    const std::vector<cl::Event>& ready() const { return ready_; }

private:
    /// A plane of the host's, beside that of a device with its own memory.
    struct HostPlane {
        std::shared_ptr<void> memory;
        std::size_t pixel_bytes = 0;
        cl::Event fetched;
    };

    bool staged(const std::string& name) const { return host_.contains(name); }
    std::size_t travelling(const std::string& name) const;
    void* memory(const std::string& name, cl_map_flags access);

    cl::CommandQueue queue_;
    std::size_t pixels_ = 0, held_ = 0;
    DevicePlanes planes_;
    std::map<std::string, HostPlane> host_;  ///< of all planes or of none
    std::map<std::string, void*> mapped_;    ///< where the device's memory is the host's: all; else those written to
    std::vector<cl::Event> ready_;
};

/// What commands that use the planes of both wait for.
inline std::vector<cl::Event> both_ready(const PlaneBuffers& a, const PlaneBuffers& b) {
    std::vector<cl::Event> events = a.ready();
    events.insert(events.end(), b.ready().begin(), b.ready().end());
    return events;
}

}  // namespace wrinkle
