#include "io/threads.h"

#include <OpenImageIO/imageio.h>

namespace wrinkle {

void set_image_threads(int threads) {
    OIIO::attribute("threads", threads);
    OIIO::attribute("exr_threads", threads);
}

}  // namespace wrinkle
