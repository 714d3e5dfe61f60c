#pragma once

namespace wrinkle {

/// Sets how many threads read and write image files, for the whole program.
void set_image_threads(int threads);

}  // namespace wrinkle
