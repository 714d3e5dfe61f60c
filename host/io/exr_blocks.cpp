#include "io/exr_blocks.h"

#include <OpenImageIO/parallel.h>
#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>

#include "io/deflate.h"
#include "io/workspaces.h"

namespace wrinkle::io {
namespace {

static_assert(std::endian::native == std::endian::little, "EXR stores numbers so");

constexpr float kLargestHalf = 65504;
constexpr std::size_t kBlockHead = 8;  // the number of its first row, and its size

using Bytes = std::vector<std::uint8_t>;

std::uint32_t rows_a_block(Compression compression) { return compression == Compression::zip ? 16 : 1; }

/// What EXR does to a block before it is deflated: all even bytes before all odd ones, then each as its difference from
/// the one before, plus 128.
void predict(const Bytes& in, Bytes& out) {
    constexpr std::uint8_t bias = 128;
    const std::size_t half = (in.size() + 1) / 2;
    out.resize(in.size());
    if (in.empty()) return;
    std::uint8_t* const odd = out.data() + half;
    for (std::size_t i = 1; i < half; ++i) out[i] = static_cast<std::uint8_t>(in[2 * i] - in[2 * i - 2] + bias);
    for (std::size_t i = 1; i < in.size() / 2; ++i)
        odd[i] = static_cast<std::uint8_t>(in[2 * i + 1] - in[2 * i - 1] + bias);
    out[0] = in[0];
    if (in.size() > 1) odd[0] = static_cast<std::uint8_t>(in[1] - in[2 * half - 2] + bias);
}

/// The memory that a thread needs for a block. It is reused, as touching fresh memory costs as much as the work.
struct Workspace {
    Bytes plain, predicted;
    Deflater deflater;
};

void store(const float* row, std::size_t width, bool half_floats, std::uint8_t* out) {
    if (!half_floats) {
        std::memcpy(out, row, width * sizeof(float));
        return;
    }
    for (std::size_t x = 0; x < width; ++x) {
        const float value = std::isfinite(row[x]) ? std::clamp(row[x], -kLargestHalf, kLargestHalf) : row[x];
        const std::uint16_t bits = half(value).bits();
        std::memcpy(out + 2 * x, &bits, sizeof bits);
    }
}

}  // namespace

struct ExrBlocks::Impl {
    /// The bytes of a row, channel after channel.
    void store_row(const PlaneRows& rows, std::uint32_t row, std::uint8_t* out) const {
        for (const std::size_t c : order) {
            store(rows.row(c, row), size.width, planes[c].half, out);
            out += size.width * (planes[c].half ? 2 : 4);
        }
    }

    /// A block as the file holds it.
    void pack(const Bytes& plain, std::uint32_t first_row, Workspace& work, Bytes& out) const {
        std::size_t packed = 0;
        out.resize(kBlockHead + plain.size());
        if (compression != Compression::none) {
            predict(plain, work.predicted);
            packed = work.deflater.pack(work.predicted, std::span(out).subspan(kBlockHead, plain.size() - 1));
        }
        if (packed == 0) {  // readers tell a block that is stored as it is by its size
            packed = plain.size();
            std::memcpy(out.data() + kBlockHead, plain.data(), packed);
        }
        out.resize(kBlockHead + packed);
        const std::int32_t head[] = {top + static_cast<std::int32_t>(first_row), static_cast<std::int32_t>(packed)};
        static_assert(sizeof head == kBlockHead);
        std::memcpy(out.data(), head, sizeof head);
    }

    void append(const Bytes& block) {
        offsets.push_back(at);
        file.pwrite(block.data(), block.size(), static_cast<std::int64_t>(at));
        at += block.size();
    }

    DescriptorProxy& file;
    std::uint64_t at;  ///< where the next block goes
    std::uint64_t table_end;
    int top;
    Size size;
    std::vector<BlockPlane> planes;
    std::vector<std::size_t> order;  ///< a file holds its channels by their names
    Compression compression;
    std::uint32_t block_rows, next_row = 0;
    std::size_t row_bytes = 0;
    Bytes begun;  ///< rows of a block that is not full yet
    std::vector<std::uint64_t> offsets;
    Workspaces<Workspace> workspaces;
    std::vector<Bytes> packed;
};

ExrBlocks::ExrBlocks(DescriptorProxy& file, int top, Size size, std::vector<BlockPlane> planes, Compression compression)
    : impl_(new Impl{.file = file,
                     .at = file.size(),
                     .table_end = file.size(),
                     .top = top,
                     .size = size,
                     .planes = std::move(planes),
                     .order = {},
                     .compression = compression,
                     .block_rows = rows_a_block(compression),
                     .begun = {},
                     .offsets = {},
                     .workspaces = {},
                     .packed = {}}) {
    Impl& impl = *impl_;
    impl.order.resize(impl.planes.size());
    std::iota(impl.order.begin(), impl.order.end(), std::size_t{0});
    std::ranges::sort(impl.order, {}, [&](std::size_t c) { return impl.planes[c].name; });
    for (const BlockPlane& plane : impl.planes) impl.row_bytes += std::size_t{size.width} * (plane.half ? 2 : 4);
}

ExrBlocks::~ExrBlocks() = default;

bool ExrBlocks::write(const PlaneRows& rows) {
    Impl& impl = *impl_;
    const std::uint32_t begun_rows = static_cast<std::uint32_t>(impl.begun.size() / impl.row_bytes);
    const std::uint32_t first = impl.next_row - begun_rows, end = impl.next_row + rows.count;
    const std::uint32_t whole_end = end == impl.size.height ? end : end - end % impl.block_rows;
    const std::uint32_t blocks = whole_end <= first ? 0 : (whole_end - first + impl.block_rows - 1) / impl.block_rows;
    impl.packed.resize(std::max<std::size_t>(impl.packed.size(), blocks));
    const auto pack_some = [&](std::int64_t from, std::int64_t to) {
        auto work = impl.workspaces.borrow();
        for (auto block = from; block < to; ++block) {
            const std::uint32_t row = first + static_cast<std::uint32_t>(block) * impl.block_rows;
            const std::uint32_t row_end = std::min(row + impl.block_rows, whole_end);
            work->plain.resize(impl.row_bytes * (row_end - row));
            if (row == first) std::ranges::copy(impl.begun, work->plain.begin());
            for (std::uint32_t y = std::max(row, impl.next_row); y < row_end; ++y)
                impl.store_row(rows, y - impl.next_row, work->plain.data() + impl.row_bytes * (y - row));
            impl.pack(work->plain, row, *work, impl.packed[static_cast<std::size_t>(block)]);
        }
        impl.workspaces.give_back(std::move(work));
    };
    OIIO::parallel_for_chunked(0, blocks, 1, pack_some);
    for (std::uint32_t block = 0; block < blocks; ++block) impl.append(impl.packed[block]);
    if (blocks > 0) impl.begun.clear();
    const std::uint32_t kept_from = std::max(blocks > 0 ? whole_end : first, impl.next_row);
    for (std::uint32_t y = kept_from; y < end; ++y) {
        impl.begun.resize(impl.begun.size() + impl.row_bytes);
        impl.store_row(rows, y - impl.next_row, impl.begun.data() + impl.begun.size() - impl.row_bytes);
    }
    impl.next_row = end;
    return impl.file.failure() == 0;
}

bool ExrBlocks::finish() {
    const std::size_t bytes = impl_->offsets.size() * sizeof(std::uint64_t);
    impl_->file.pwrite(impl_->offsets.data(), bytes, static_cast<std::int64_t>(impl_->table_end - bytes));
    return impl_->file.failure() == 0;
}

}  // namespace wrinkle::io
