#pragma once

namespace wrinkle {

/// How many threads image files are decompressed and compressed with; for the whole program.
void set_image_threads(int threads);

}  // namespace wrinkle
