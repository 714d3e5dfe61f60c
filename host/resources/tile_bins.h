#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plan/plan.h"
#include "wrinkle/passes.h"

namespace wrinkle {

struct BinBounds;

/// What the bins of one band hold; read back for reports and tests.
struct BinReport {
    std::uint64_t rows = 0;       ///< of the table
    std::uint32_t tiles = 0;      ///< that cover the rows
    std::uint32_t touched = 0;    ///< tiles whose list is not empty
    std::uint32_t inherited = 0;  ///< tiles that use the list of the block around them, as their own found no room
    std::uint64_t entries = 0;    ///< of all tiles' lists
    std::uint32_t longest = 0;
    std::uint64_t bytes = 0;  ///< of tables, bounds and lists on the device
};

/// Bins the rows of tables, of decals or of lights, to tiles of the frame, on the device, before the kernels that
/// evaluate them: nothing is read back, so enqueueing never waits. kernels/bins says how.
class TileBins {
public:
    TileBins() = default;
    TileBins(const Device& device, const cl::Program& program, std::size_t rows, int lanes);

    std::size_t rows() const { return rows_; }

    /// The rows as one camera sees them, and the buffer that kernels read them from, of doubles or of floats.
    void set_camera(const BinBounds& bounds, cl::Buffer table, bool fp64);

    /// Bins for rows of the frame. `in` are the planes, in which the rows begin at pixel `in_first`.
    cl::Event enqueue(const cl::Buffer& frame, const cl::Buffer& numbers, const std::vector<cl::Buffer>& in,
                      const Rows& rows, std::uint32_t width, std::uint32_t in_first, std::uint32_t in_pixels,
                      const std::vector<cl::Event>& wait);

    /// Sets the arguments of a kernel that evaluates: table, lists, entries, super blocks a row.
    void set_arguments(cl::Kernel& kernel, cl_uint& first) const;

    /// The event after which the lists are free again.
    void used_until(const cl::Event& event) { last_use_ = {event}; }

    /// The lists of the rows enqueued last, once they are made; blocks. `lists` gets the list of each tile, from left
    /// to right and top to bottom: numbers of rows in the order of evaluation.
    BinReport read(std::uint32_t width, std::uint32_t rows,
                   std::vector<std::vector<std::uint32_t>>* lists = nullptr) const;

    /// Room for that many entries of lists; 0: for as many as frames usually need. For tests.
    void limit_entries(std::uint32_t entries) { limit_ = entries; }

private:
    void make_room(std::uint32_t supers);

    Device device_;
    std::uint32_t rows_ = 0, rooms_for_ = 0, capacity_ = 0, limit_ = 0, supers_a_row_ = 0, supers_ = 0;
    std::size_t group_ = 1;
    std::vector<std::uint32_t> numbers_;
    cl::Kernel tiles_kernel_, parents_kernel_, supers_kernel_, lists_kernel_;
    cl::Buffer table_, boxes_, bounds_, groups_, axes_;
    std::array<cl::Buffer, 3> tile_bounds_, lists_;  ///< of tiles, blocks, super blocks
    cl::Buffer entries_, hits_, used_;
    std::vector<cl::Event> made_, last_use_;  ///< the lists; and what reads them
    std::uint64_t table_bytes_ = 0, room_bytes_ = 0;
};

}  // namespace wrinkle
