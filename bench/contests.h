#pragma once

#include <filesystem>

#include "record.h"
#include "wrinkle/camera.h"
#include "wrinkle/device.h"

/// Contests: several ways to do one job take turns in one race, each recorded with its error. bars.cpp judges them.
namespace wrinkle::bench {

/// Eight box decals over a frame, by the kernel and by C++ written plainly, for the compiler to vectorise, and
/// vectorised by hand. Group "stack".
void measure_stack(const Device& device, Size size, Run& run);

/// Kernels for eight octaves of Perlin noise: with the analytic gradient, with gradients by differences, and the value
/// alone. Group "noise".
void measure_noise(const Device& device, Run& run);

/// Screen derivatives of a pinhole camera, and a copy of as many bytes. Group "screen".
void measure_screen(const Device& device, Size size, Run& run);

/// Scenes that are limited by arithmetic, on one core and on two. Group "cores". Measures nothing on a device that
/// cannot be divided.
void measure_cores(const Device& device, Size size, Run& run);

/// `wrinkle run` on a generated frame of 27 channels, beside programs that only read and write the same files: oiiotool
/// for normals alone, and for all passes (`passthrough`); OpenEXR and libpng for the files of a run as it is by
/// default. Group "files". Without oiiotool it says so and measures nothing.
void measure_files(Size size, Run& run);

/// Resolve from normals and gradients stored as floats and in fewer bytes: alone, to floats, and as a pass, to normals
/// stored alike. Errors are against what was to be stored. Group "storage".
void measure_storage(const Device& device, Size size, Run& run);

/// A height map at 16 points of a pixel's area on a ground to the horizon, by texture coordinates that are stored and
/// by those of positions, from planes stored as floats and in fewer bytes, to normals stored alike. Errors are against
/// the mean over each pixel's area. Group "storage".
void measure_stored_area(const Device& device, Run& run);

/// A scene as it is, and with one saving left out at a time: with the layers of other scenes compiled in and skipped by
/// branches; without skipping pixels; without footprints; without fusing. Group "ablation".
void measure_ablation(const Device& device, const std::filesystem::path& file, Size size, Run& run);

/// A scene without its lighting, with it, and with suns as wide as the sun is, at one point of each pixel; and the
/// first two at as many points as the scene says. Errors are those of normals. Group "lighting".
void measure_lighting(const Device& device, const std::filesystem::path& file, Size size, Run& run);

/// Layers on a ground to the horizon, a wall along the view and a ball at 1 to 16 points of a pixel's area, and by
/// brute force at 2 x 2 to 8 x 8, whose averaging is not timed; and height and normal maps on the ground by
/// OpenImageIO's TextureSystem. Errors are against the mean over each pixel's area, by the reference at 1024 points.
/// Group "area".
void measure_area(const Device& device, Run& run);

/// One layer over a whole frame of half the width and height. Noise: 2, 4 and 8 octaves, analytic gradients and
/// differences. A height map: bilinear, smooth and by three taps, with mips and without. Noise of 8 octaves and the
/// smooth map with mips also on 1, 4, 8 and 16 lanes. Group "variant".
void measure_variants(const Device& device, Size size, Run& run);

/// The scene file of measure_stack.
std::filesystem::path stack_scene();

}  // namespace wrinkle::bench
