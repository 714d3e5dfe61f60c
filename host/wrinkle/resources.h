#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "wrinkle/camera.h"
#include "wrinkle/decal_layers.h"
#include "wrinkle/layers.h"
#include "wrinkle/textures.h"

/// What the installed kernel functions read besides planes, for programs that enqueue kernels of their own: cameras,
/// projectors, textures and volumes. A struct is given as numbers, in the order of its members in kernels/layout.h and
/// of the offsets in kernels/README.md. Copy them into a buffer as they are for kernels built with WR_FP64; for others,
/// which compute in float, narrow each to float first. Positions in them are relative to the eye, so narrowing loses
/// nothing that shows.
///
///     const auto camera = wrinkle::Camera::look_at({0, -5, 2}, {0, 0, 0}, {0, 0, 1}, 0.9, 16.0 / 9);
///     const std::vector<double> numbers = wrinkle::camera_numbers(camera, {1920, 1080});
///     const std::vector<float> narrowed(numbers.begin(), numbers.end());
///     const std::vector<float> heights(64 * 32, 0.5f);
///     const wrinkle::ImageSource flat{.memory = wrinkle::ImageInMemory{64, 32, 1, heights}};
///     const wrinkle::VolumeSource fog{.file = "fog.vdb", .grid = "density"};
///     const std::vector<wrinkle::TextureSource> sources{flat};  // or {flat, fog}
///     const wrinkle::TexelData data = wrinkle::texel_data(sources);
///     const wrinkle::Projector seal{.center = {0, 0, 0.1}, .half_size = {0.5, 0.5, 0.2}, .scale = 0.01};
///     const auto row = wrinkle::projector_numbers(seal, {.texture = 0, .height = true}, wrinkle::eye_of(camera));
///
/// Threads: values, and functions that keep nothing between calls: all of it may be called from several at once.
namespace [[gnu::visibility("default")]] wrinkle {

/// Where the camera stands, world, metres: what positions in kernels are relative to. Of a parallel projection: the
/// origin of its view space. Throws Error where `camera.view` is singular or holds a number that is not finite.
Vec3 eye_of(const Camera& camera);

/// A wr_camera: 76 numbers. Members that end in _low are what a float leaves of the member without it. Both `d0`, `dx`,
/// `dy` (pinholes and parallel projections) and `c0` ... `w` (any projection) are set. Throws Error for a frame without
/// pixels, and where a matrix is singular or holds a number that is not finite.
std::vector<double> camera_numbers(const Camera& camera, Size size);

/// A wr_projector: 32 numbers; a table of projectors is one row after another.
/// - `row`: the projector; `texture` and `region` are not read, as `image` says where the texels are. `cryptomatte` is
///   hashed, unless it is "#" and 8 hex digits.
/// - `image`: number of its texture in TexelData::textures, and whether that has the slopes of heights.
/// - `eye`: world, metres; eye_of() the camera.
/// - `scale`: multiplies the row's own.
/// Kernels leave the masks to the caller: wr_projector's `mask`, `object` and `object_low` say what to compare.
/// Throws Error naming what is not finite. A row with a half size of 0 or less covers nothing, and is no error.
std::vector<double> projector_numbers(const Projector& row, const ProjectedImage& image, const Vec3& eye,
                                      double scale = 1);

/// What becomes of an image's texels: what the sampling functions of kernels/sources/ expect to find.
enum class TexelStore {
    slopes,  ///< two floats, dh/ds and dh/dt with t up: of heights, by the Sobel operator, per unit of texture; of
             ///< tangent-space normals, as they are tilted; of slopes, as `unit` says. For wr_texture_sample2, wr_slope
    values,  ///< one float: heights or masks as they are. For wr_texture_sample1, wr_height
    vectors,  ///< four floats, the last of which is 0: object-space normals. For wr_texture_sample3
};

/// An image in the caller's memory, which is read during the call only: rows from the top to the bottom, channels
/// interleaved; width * height * channels numbers, all finite. They mean what those of a float file would: heights as
/// they are, normals as (n + 1) / 2 or as they are, told apart by their lengths.
struct ImageInMemory {
    std::uint32_t width = 0, height = 0, channels = 0;
    std::span<const float> texels;
};

/// An image as a texture with all its mip levels.
struct ImageSource {
    TextureUse use{};                       ///< the file, unless it is in memory; what texels mean, how they wrap;
                                            ///< `upscale` is not read
    std::optional<ImageInMemory> memory{};  ///< instead of a file
    TexelStore store = TexelStore::slopes;
    std::array<double, 4> region{0, 0, 1, 1};  ///< the part that is used: s and t from, s and t to; whole texels
};

/// A grid of an OpenVDB or NanoVDB file, for the functions of kernels/sources/volume.clh.
struct VolumeSource {
    std::filesystem::path file{};
    std::string grid{};                          ///< empty: the only one of the file
    VolumeFilter filter = VolumeFilter::linear;  ///< how it will be sampled: wr_volume_trilinear, wr_volume_vector;
                                                 ///< smooth: wr_volume_bspline
};

using TextureSource = std::variant<ImageSource, VolumeSource>;

/// Textures and volumes as kernels read them: wr_texture_at(texels, textures, number), wr_volume_at likewise, where
/// `number` counts the sources. kernels/sources/texture.clh and volume.clh say how they lie in memory.
struct TexelData {
    std::vector<float> texels;
    std::vector<std::uint32_t> textures;  ///< WR_TEXTURE_WORDS numbers for each source
    std::vector<Mat4> index_from_world;   ///< of each source: from world positions to a volume's voxels; 1 of images
};

/// Reads all sources into one buffer. Throws Error, with the number of the source, for files that cannot be used, for
/// images without pixels, of too few numbers for their size or with one that is not finite, for a region that is none,
/// for contents that cannot be stored in the way wanted, and for more than 8 GiB together.
TexelData texel_data(std::span<const TextureSource> sources);

}  // namespace wrinkle
