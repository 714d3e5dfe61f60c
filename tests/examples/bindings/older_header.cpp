// What <CL/cl.hpp> of OpenCL 1 defines; this is refused in words.
#define CL_HPP_
#include "wrinkle/device.h"
