#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// How planes lie in memory that are not one float a pixel: as the G-buffers of engines hold them. A pass is compiled
/// for the formats of its planes, and reads and writes them as they are.
///
///     wrinkle::Frame frame{size, camera, {"depth", "normal.x", "normal.y", "normal.z", "roughness"}};
///     using enum wrinkle::PlaneEncoding;
///     frame.formats = wrinkle::interleaved("normals", octahedral16, {"normal.x", "normal.y", "normal.z"});
///     frame.formats["roughness"] = {.encoding = unorm8};
///     frame.formats["depth"] = {.encoding = half};
///
/// Threads: values, used as any other.
namespace [[gnu::visibility("default")]] wrinkle {

/// What a stored number means. Integers of n bits are unsigned, from 0 to 2^n - 1, or signed.
///
///   encoding           bytes   numbers                                 largest error of storing one
///   float32            4       any                                     0
///   half               2       to 65504, and Inf, NaN (IEEE)           2^-11 of it; below 2^-14: 2^-25
///   unorm8, unorm16    1, 2    0 to 1                                  1/510, 1/131070
///   snorm8, snorm16    1, 2    -1 to 1; the lowest integer is -1, too  1/254, 1/65534
///   octahedral8, 16    2, 4    normals                                 0.95, 0.0037 degrees
///   uint32             4       whole ones                              0
///
/// Octahedral normals are two signed integers, u in the lower bytes [Cigolle et al. 2014]. Whole numbers are those of
/// objects, all of whose 32 bits count, Cryptomatte's ids as they are, or of other planes numbers up to 2^24. A mask
/// cannot tell an object below 2^24 from one whose number has the bits of the float of the former's: 1 from 1065353216.
///
/// Beside that, reading integers adds 1.2e-7 of the largest number; halves and octahedral normals are read exactly.
/// What integers cannot hold is written as the nearest that they can, NaN as 0. An octahedral normal always has a
/// direction, and no integer of unorm8 or unorm16 stands for 0 in -1 to 1: background is told by the depth then. The
/// normals of invalid pixels come out of octahedral ones with a length between 0.5 and 1.
///
/// What that does to the mean over a pixel's area, of a height map of 0.05 m on a ground to the horizon at 16 taps:
/// depth or texture coordinates as half, by which the map is placed, raise its median error from 0.33 to 0.7 degrees;
/// octahedral16 normals with the rest in floats leave it as it is (bench/README.md, "A pixel's area").
enum class PlaneEncoding { float32, half, unorm8, unorm16, snorm8, snorm16, octahedral8, octahedral16, uint32 };

/// How a plane is stored. Numbers have to lie at multiples of their size.
struct PlaneFormat {
    PlaneEncoding encoding = PlaneEncoding::float32;
    std::uint32_t offset = 0;    ///< bytes from the beginning of a pixel to the number
    std::uint32_t stride = 0;    ///< bytes from pixel to pixel; 0: those of the encoding, with no others between
    double scale = 1, bias = 0;  ///< the plane's number is stored * scale + bias; normals in unorm8: 2 and -1
    std::string memory{};        ///< by which name its memory is given to a pass: planes that lie in pixels together
                                 ///< share one, and its stride; empty: the plane's own name
    bool operator==(const PlaneFormat&) const = default;
};

using PlaneFormats = std::map<std::string, PlaneFormat>;  ///< by plane; those not in it are floats

/// Bytes of a stored number; of octahedral ones, of both.
std::uint32_t bytes_of(PlaneEncoding encoding);

/// "float32", "half", "unorm8" ...
std::string encoding_name(PlaneEncoding encoding);

/// Pixels of equal numbers, one after another: an RGBA image is four planes, one in which nothing is wanted is "".
/// Octahedral ones are the three of a normal. The memory is called `memory`.
///
///     const auto rgba = wrinkle::interleaved("gbuffer0", wrinkle::PlaneEncoding::unorm8,
///                                            {"albedo.r", "albedo.g", "albedo.b", "roughness"});
///
/// Errors: octahedral pixels hold nothing but one normal, so that no other plane may be named, nor a gap.
PlaneFormats interleaved(const std::string& memory, PlaneEncoding encoding, const std::vector<std::string>& planes,
                         double scale = 1, double bias = 0);

/// What a plane "depth" holds that is no length: the numbers of a depth buffer, clip z / clip w of the frame's own
/// camera, whose projection may be reversed and have its far plane at infinity. Its numbers are stored in any format.
/// At the value of the far plane (1; 0 of a reversed projection) a pixel is background.
///
/// A step s of the buffer's numbers is one of s z^2 / |proj[2][3]| metres at view depth z: with floats and a near plane
/// of 0.1 m 6e-7 z^2, but if the projection is reversed 1.2e-7 z at most. Reading adds 2e-7 of z.
enum class DeviceDepth {
    none,
    zero_to_one,       ///< of Direct3D, Vulkan, Metal, glClipControl: z / w as it is
    minus_one_to_one,  ///< of OpenGL: z / w is from -1 to 1, and the plane holds (z / w + 1) / 2
};

}  // namespace wrinkle
