// This header comes first, with settings of the program's own.
#define CL_HPP_TARGET_OPENCL_VERSION 300
#define CL_HPP_MINIMUM_OPENCL_VERSION 200
#include "wrinkle/passes.h"

static_assert(CL_HPP_TARGET_OPENCL_VERSION == 300 && CL_HPP_MINIMUM_OPENCL_VERSION == 200);
