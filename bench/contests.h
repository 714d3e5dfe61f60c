#pragma once

#include <filesystem>

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

/// Contests that the bars of bars.cpp are about: contenders for one job, turn by turn in one race, each with its error.
namespace wrinkle::bench {

/// Eight box decals over a frame: the kernel, and C++ plain, for the vectoriser, and vectorised by hand. Group "stack".
void measure_stack(const Device& device, Size size, Run& run);

/// Eight octaves of Perlin noise with gradient, by differences, and values alone; in kernels. Group "noise".
void measure_noise(const Device& device, Run& run);

/// Screen derivatives of a pinhole camera beside a copy of as many planes. Group "screen".
void measure_screen(const Device& device, Size size, Run& run);

/// Scenes that compute rather than load, on one core and on two. Group "cores"; nothing on a device that cannot be
/// divided.
void measure_cores(const Device& device, Size size, Run& run);

/// `wrinkle run` on a generated frame of 27 channels beside oiiotool, which only reads and writes. Group "files";
/// nothing, with a line that says so, where there is no oiiotool.
void measure_files(Size size, Run& run);

/// Resolve from normals and gradients stored as float, half, or octahedral integers. Group "storage".
void measure_storage(const Device& device, Size size, Run& run);

/// A scene with only what it needs, and without one saving at a time: with everything compiled in and branched at run
/// time, without skipping, without footprints, without fusing. Group "ablation".
void measure_ablation(const Device& device, const std::filesystem::path& file, Size size, Run& run);

/// One layer over all of a frame of half the width and height: noise of 2, 4 and 8 octaves, by gradients and by
/// differences; a height map bilinear, smooth and by three taps, with mips and without; one of each on 1, 4, 8 and 16
/// lanes. Group "variant".
void measure_variants(const Device& device, Size size, Run& run);

/// The scene of the stack of decals.
std::filesystem::path stack_scene();

}  // namespace wrinkle::bench
