#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wrinkle::io {

/// An object that a pixel shows.
struct Seen {
    std::uint32_t id = 0;
    float coverage = 0;
};

/// A row of the planes that tell which object is in front: what its pixels show, and where a surface ends.
struct RowOfPlanes {
    std::size_t width;
    std::span<const float*const> ranks, normal, place;  ///< ids and coverages in turn; depth or position
    const float* object;                                ///< numbers, or null

    /// Counts what each pixel shows; where that is one object, it is the one in front. Whether some show several.
    bool count(std::uint8_t* counts, float* front) const;

    /// What pixel x shows, what covers most of it first.
    void seen(std::size_t x, std::vector<Seen>& out) const;

    /// Whether pixels x and x + 1 lie on one surface. What is not finite lies on none.
    bool goes_on(std::size_t x) const;

    /// Whether the surface of pixel x, gone on to pixel `front`, would be behind that, and that of `front` before x:
    /// at a crease they would meet. `before` is on x's surface and `after` on the other, one pixel farther away or
    /// none.
    bool behind(std::size_t x, std::size_t before, std::size_t front, std::size_t after) const;

private:
    bool is_surface(std::size_t x) const;
    float step(std::size_t x) const;
    bool rises(std::size_t x, std::size_t from, std::size_t to) const;
};

}  // namespace wrinkle::io
