#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "wrinkle/camera.h"

/// How a layer uses a texture, and where on the surface.
///
///     const wrinkle::TextureUse bricks{.file = "bricks.png", .content = wrinkle::Content::normal, .y_down = true};
///     const wrinkle::UvMapping four_times{.scale = {4, 4}};
///
/// Threads: values, used as any other: read by several at once, or changed by one.
namespace [[gnu::visibility("default")]] wrinkle {

/// What the texels mean: heights in units of `scale`; tangent-space normals; slopes dh/du, dh/dv; normals in object or
/// world space.
enum class Content { height, normal, slope, object_normal };
/// How heights become slopes: [Mik20 listing 16] with isUpscaleHQ false or true; [Mik20 listing 7], three taps a pixel
/// apart, to compare with, of height maps that repeat only.
enum class Upscale { plain, smooth, taps };
enum class Wrap { repeat, clamp };
enum class Encoding { automatic, sign, unit };  ///< slopes as they are, or 2 texel - 1; automatic: by the file's format
enum class SlopeUnit { texel, texture, metre };  ///< what a slope of 1 rises over; metre: decals

struct TextureUse {
    std::filesystem::path file{};
    Content content = Content::height;
    Upscale upscale = Upscale::smooth;
    Wrap wrap = Wrap::repeat;
    bool y_down = false;  ///< `y = "-"`: green points down (DirectX), t slopes change sign; tangent normals and slopes
    Encoding encoding = Encoding::automatic;  ///< slopes only
    SlopeUnit unit = SlopeUnit::texel;        ///< slopes only
    std::string layer{};                      ///< of a file with several; empty: the one that fits the content
    std::vector<std::string> channels{};      ///< names of channels, as many as the content takes; empty: by the layer
    int zero = 0;  ///< stored number that means 0, of packed normals and slopes of integers (128 of 255); 0: the middle
    bool operator==(const TextureUse&) const = default;
};

enum class UvSource { aov, planar };

/// (s,t) = rotate(scale * (u,v), rotation) + offset. t up. `planar`: u = axis_u . p, v = axis_v . p, world metres.
struct UvMapping {
    UvSource source = UvSource::aov;
    std::array<double, 2> scale{1, 1}, offset{0, 0};
    double rotation = 0;  ///< radians, anticlockwise
    Vec3 axis_u{1, 0, 0}, axis_v{0, 1, 0};
};

}  // namespace wrinkle
