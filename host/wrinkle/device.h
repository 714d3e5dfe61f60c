#pragma once

// OpenCL's C++ bindings may be included before this header, with any settings: the library keeps its own copy of them
// to itself. Where they were not, and nothing was set, they are those of OpenCL 1.2 and throw cl::Error.
#ifdef CL_HPP_
#ifndef CL_HPP_TARGET_OPENCL_VERSION
#error "wrinkle/device.h needs the OpenCL bindings <CL/opencl.hpp>; include them instead of the older <CL/cl.hpp>"
#endif
#else
#if !defined(CL_HPP_TARGET_OPENCL_VERSION) && !defined(CL_HPP_MINIMUM_OPENCL_VERSION)
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#endif
#ifndef CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_ENABLE_EXCEPTIONS
#endif
#endif
#include <CL/opencl.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace [[gnu::visibility("default")]] wrinkle {

/// What `wrinkle devices` lists.
struct DeviceInfo {
    std::string platform, name, driver, version;
    std::string type;  ///< "cpu", "gpu", "accelerator"
    unsigned compute_units = 0;
    std::uint64_t memory = 0;          ///< bytes
    std::uint64_t largest_buffer = 0;  ///< bytes that all textures and volumes together may take
    int lanes = 1;                     ///< pixels a work-item evaluates unless a pass says otherwise: 1, 4, 8 or 16
    bool fp64 = false;
    bool own_memory = false;  ///< not the host's: a discrete GPU's, to and from which planes are copied
};

/// Every OpenCL device of this machine that can say what it is, in the order of the ICD loader. Throws Error, naming
/// the package to install, when there is none.
std::vector<DeviceInfo> list_devices();

/// An OpenCL device to work on. A value: copies share the context and the queue.
///
/// Threads: list_devices(), open() and adopt() may be called from any of them, and several may use copies of one
/// Device, or the same one, at once. What they enqueue shares its queue; threads that are to overlap on the device take
/// a queue each, or one that is out of order.
///
///     for (const wrinkle::DeviceInfo& info : wrinkle::list_devices()) std::cout << info.name << '\n';
///     const auto device = wrinkle::Device::open();                             // a GPU, else a CPU
///     const auto same = wrinkle::Device::adopt(device.context, device.queue);  // or any context and queue of yours
struct Device {
    cl::Device device;
    cl::Context context;
    cl::CommandQueue queue;
    DeviceInfo info;

    /// The device whose number in list_devices() or type is `wanted`, or a part of its name, platform or version
    /// ("pocl"). When empty, WRINKLE_DEVICE says so; without that it is a GPU, else the CPU with the most vector lanes
    /// over all its compute units. Throws Error listing the devices when nothing matches.
    static Device open(const std::string& wanted = {});

    /// Works in the caller's context and on the caller's queue: in order or out of order, with or without profiling,
    /// for every command waits for the events of those it needs. Throws Error when the queue is of another context, or
    /// one on the device, which the host cannot enqueue to.
    static Device adopt(const cl::Context& context, const cl::CommandQueue& queue);
};

/// Planes given to kernels hold this many floats for `pixels` pixels: whole lane groups, so that the last work-item
/// needs no guard.
constexpr std::size_t padded(std::size_t pixels) { return (pixels + 63) / 64 * 64; }

}  // namespace wrinkle
