// A program for OpenCL 1.1.
#define CL_HPP_TARGET_OPENCL_VERSION 110
#define CL_HPP_MINIMUM_OPENCL_VERSION 110
#include "wrinkle/passes.h"
