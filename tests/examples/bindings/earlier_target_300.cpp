// OpenCL's bindings came first, for OpenCL 3.0 and without exceptions.
#define CL_HPP_TARGET_OPENCL_VERSION 300
#define CL_HPP_MINIMUM_OPENCL_VERSION 200
#include <CL/opencl.hpp>

#include "wrinkle/passes.h"

static_assert(sizeof(wrinkle::Device::queue) == sizeof(cl_command_queue));
