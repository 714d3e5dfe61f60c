#pragma once

#include "run/pass_impl.h"
#include "run/plane_buffers.h"

namespace wrinkle {

/// How a frame is cut into bands of rows, the last one shorter.
struct BandGrid {
    Size size;
    std::uint32_t rows = 0;  ///< of a band
    std::uint32_t halo = 0;  ///< rows before and after a band that are read too

    std::uint32_t count() const { return (size.height + rows - 1) / rows; }
    Rows rows_of(std::uint32_t band) const;
    std::size_t pixels() const { return std::size_t{size.width} * rows; }
    std::size_t read_pixels() const { return std::size_t{size.width} * (rows + std::size_t{2} * halo); }
};

/// Pixels of a band, of a frame of which `in_flight` bands are in memory at a time: what a device needs to be busy.
///
/// Where its memory is the host's, 65,536 for each of 2 to 16 compute units, or a million where bands do not overlap. A
/// device with its own has more threads, and transfers want their length, too: 16,384 a compute unit, which is several
/// times as many as it has threads, but no more than an eighth of the frame, so that bands overlap; 262,144 at least,
/// as such a transfer takes far longer than it takes to start, and 4 million at most.
///
/// All bands together take no more than a sixteenth of the device's memory (`bytes_of_pixel`: of all planes), and no
/// plane more than its largest allocation (`widest`: bytes of a pixel of the widest plane).
std::size_t band_pixels(const DeviceInfo& device, std::size_t frame_pixels, double bytes_of_pixel, double widest,
                        std::uint32_t in_flight);

/// The bands of a pass's frame: of as many rows as that, a multiple of `step`.
BandGrid band_grid(const Pass::Impl& impl, std::uint32_t step, std::uint32_t in_flight);

/// The planes of a band, and the rows that they are of now.
struct [[gnu::visibility("hidden")]] Band {
    PlaneBuffers inputs, outputs;
    Rows rows;

    /// `names`: of the planes that are read.
    Band(const Pass::Impl& impl, const BandGrid& grid, const std::vector<std::string>& names);

    /// Takes other rows of the grid; its planes are the host's until they are unmapped.
    void begin(const BandGrid& grid, std::uint32_t band);

    /// Enqueues and flushes the evaluation of `of`, some or all of the rows, from inputs that were unmapped.
    cl::Event enqueue(Pass::Impl & impl, const Rows& of);
};

}  // namespace wrinkle
