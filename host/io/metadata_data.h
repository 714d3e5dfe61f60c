#pragma once

#include <OpenImageIO/paramlist.h>

#include "io/metadata.h"

namespace wrinkle {

/// For host/io only: Metadata as OpenImageIO sees it.
struct Metadata::Data {
    OIIO::ParamValueList list;
};

}  // namespace wrinkle
