#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/gbuffer_roles.h"

namespace wrinkle::io {

/// The plane of Cryptomatte ids, as float bits, of the objects whose surfaces the depth and normal passes show. 0 where
/// no object is seen, kNobodyKnows where several are and nothing tells which of them it is.
constexpr std::string_view kFrontPlane = "crypto.front";
constexpr float kNobodyKnows = -0.0f;

/// Tells which of the objects that a pixel shows is the surface that its depth and normal are of: a Cryptomatte also
/// lists what is seen through a leaf that is half transparent, and what lies beside an edge.
///
/// Each row is parted where depth or position, normal or object number jump. An object that is alone in some pixel of a
/// part is the surface of all its pixels that show it. Where none is alone, it is not what is alone beyond the jumps
/// and goes on behind the part; of what remains it is the object that covers most by far.
class FrontObjects {
public:
    explicit FrontObjects(const RoleMap& roles);

    /// Planes that it takes to tell; none where the frame lacks some.
    const std::vector<std::string>& needed() const { return needed_; }

    /// Reads `count` pixels of `planes`, of which one is kFrontPlane and the others are left to `read`. Rows hold
    /// `width` pixels.
    using Read = std::function<void(std::span<const std::string>, std::span<float* const>)>;
    void read(std::span<const std::string> planes, std::span<float* const> out, std::size_t width, std::size_t count,
              const Read& read) const;

    /// Finds them in whole rows; `planes` are the needed ones, in their order.
    void find(std::span<const float* const> planes, std::size_t width, std::span<float> front) const;

private:
    std::vector<std::string> needed_;  ///< ranks, then normals, then depth or position, then perhaps object
    std::size_t ranks_ = 0, places_ = 0;
    bool object_ = false;
};

}  // namespace wrinkle::io
