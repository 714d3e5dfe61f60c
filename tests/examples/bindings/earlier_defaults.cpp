// OpenCL's bindings came first, as they are without any settings.
#include <CL/opencl.hpp>

#include "wrinkle/passes.h"
