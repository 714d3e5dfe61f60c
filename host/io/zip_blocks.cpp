#include "io/zip_blocks.h"

#include <Imath/half.h>
#include <OpenEXR/openexr.h>
#include <OpenImageIO/parallel.h>
#include <libdeflate.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "io/workspaces.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

static_assert(std::endian::native == std::endian::little, "EXR stores numbers so");

struct StoredChannel {
    std::string name;
    bool half = false, whole_numbers = false;
    std::size_t row_bytes = 0;
};

struct StoredPart {
    int top = 0, height = 0, block_rows = 0;
    std::size_t width = 0, row_bytes = 0;
    std::vector<StoredChannel> channels;  ///< in the order in which a row stores them
};

/// Rows that a block of a ZIP compression holds. The library's own answer is 0 where a scanline file has an attribute
/// "tiles", so it is only compared.
int rows_a_block(exr_compression_t compression) {
    constexpr int kZipRows = 16;
    return compression == EXR_COMPRESSION_ZIP ? kZipRows : 1;
}

/// The channels of a part. Nothing when the part is not stored as ZIP scanlines with one sample a pixel, or is not what
/// `expected` says.
std::optional<StoredPart> list(exr_const_context_t file, int part, const Part& expected) {
    exr_storage_t storage{};
    exr_compression_t compression{};
    exr_attr_box2i_t window{};
    const exr_attr_chlist_t* channels = nullptr;
    StoredPart result;
    if (exr_get_storage(file, part, &storage) != EXR_ERR_SUCCESS || storage != EXR_STORAGE_SCANLINE ||
        exr_get_compression(file, part, &compression) != EXR_ERR_SUCCESS ||
        (compression != EXR_COMPRESSION_ZIP && compression != EXR_COMPRESSION_ZIPS) ||
        exr_get_data_window(file, part, &window) != EXR_ERR_SUCCESS ||
        exr_get_scanlines_per_chunk(file, part, &result.block_rows) != EXR_ERR_SUCCESS ||
        exr_get_channels(file, part, &channels) != EXR_ERR_SUCCESS)
        return {};
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                       height = std::int64_t{window.max.y} - window.min.y + 1;
    if (result.block_rows != rows_a_block(compression) || expected.tile_height != 0 ||
        window.min.x != expected.origin_x || window.min.y != expected.origin_y || width != expected.width ||
        height != expected.height || width < 1 || height < 1)
        return {};
    result.top = window.min.y;
    result.height = expected.height;
    result.width = static_cast<std::size_t>(width);
    for (const auto& channel : std::span(channels->entries, static_cast<std::size_t>(channels->num_channels))) {
        if (channel.x_sampling != 1 || channel.y_sampling != 1) return {};
        const bool half = channel.pixel_type == EXR_PIXEL_HALF;
        if (!half && channel.pixel_type != EXR_PIXEL_FLOAT && channel.pixel_type != EXR_PIXEL_UINT) return {};
        result.channels.push_back(
            {channel.name.str, half, channel.pixel_type == EXR_PIXEL_UINT, result.width * (half ? 2 : 4)});
        result.row_bytes += result.channels.back().row_bytes;
    }
    return result;
}

/// Sixteen bytes, which SSE2 and NEON add at once.
using Bytes16 [[gnu::vector_size(16)]] = std::uint8_t;

/// Element i is the sum of the elements up to i, modulo 256.
Bytes16 running_sum(Bytes16 v) {
    const Bytes16 zero{};
    v += __builtin_shufflevector(zero, v, 0, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29, 30);
    v += __builtin_shufflevector(zero, v, 0, 0, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27, 28, 29);
    v += __builtin_shufflevector(zero, v, 0, 0, 0, 0, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27);
    v += __builtin_shufflevector(zero, v, 0, 0, 0, 0, 0, 0, 0, 0, 16, 17, 18, 19, 20, 21, 22, 23);
    return v;
}

/// Undoes what EXR does to a block before it is deflated: it puts all even bytes before all odd ones, then stores each
/// byte as its difference from the one before, plus 128.
class PredictedBytes {
public:
    explicit PredictedBytes(std::span<const std::uint8_t> block) : even_(block.data()), odd_(even_ + block.size() / 2) {
        odd_last_ = after(even_last_, even_, block.size() / 2);
    }

    void skip(std::size_t bytes) {
        even_last_ = after(even_last_, even_, bytes / 2);
        odd_last_ = after(odd_last_, odd_, bytes / 2);
        even_ += bytes / 2, odd_ += bytes / 2;
    }

    void take(std::span<std::uint8_t> out) {
        std::uint8_t even = even_last_, odd = odd_last_;
        std::size_t i = 0;
        for (; i + sizeof(Bytes16) <= out.size() / 2; i += sizeof(Bytes16)) {
            Bytes16 evens, odds;
            std::memcpy(&evens, even_ + i, sizeof evens);
            std::memcpy(&odds, odd_ + i, sizeof odds);
            evens = running_sum(evens - bias) + even, odds = running_sum(odds - bias) + odd;
            const Bytes16 first =
                __builtin_shufflevector(evens, odds, 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
            const Bytes16 second =
                __builtin_shufflevector(evens, odds, 8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
            std::memcpy(&out[2 * i], &first, sizeof first);
            std::memcpy(&out[2 * i + sizeof first], &second, sizeof second);
            even = evens[15], odd = odds[15];
        }
        for (; i < out.size() / 2; ++i) {
            out[2 * i] = even = static_cast<std::uint8_t>(even + even_[i] - bias);
            out[2 * i + 1] = odd = static_cast<std::uint8_t>(odd + odd_[i] - bias);
        }
        even_last_ = even, odd_last_ = odd;
        even_ += out.size() / 2, odd_ += out.size() / 2;
    }

private:
    static constexpr std::uint8_t bias = 128;

    /// The byte reached from `last` after `count` differences. They add up modulo 256, so only their sum is needed and
    /// none of the bytes between.
    static std::uint8_t after(std::uint8_t last, const std::uint8_t* differences, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) last = static_cast<std::uint8_t>(last + differences[i]);
        return static_cast<std::uint8_t>(last - count * bias);
    }

    const std::uint8_t *even_, *odd_;
    std::uint8_t even_last_ = bias, odd_last_ = 0;  // the first byte is stored as it is
};

struct FreeDecompressor {
    void operator()(libdeflate_decompressor* decompressor) const { libdeflate_free_decompressor(decompressor); }
};

/// The memory that a thread needs for a block. It is reused, as touching fresh memory costs as much as the work.
struct Workspace {
    std::vector<std::uint8_t> packed, inflated, row;
    std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor{libdeflate_alloc_decompressor()};
};

void convert(const std::uint8_t* row, const StoredPart& part, bool half, float* out, std::size_t stride) {
    for (std::size_t x = 0; x < part.width; ++x) {
        if (half) {
            std::uint16_t bits;
            std::memcpy(&bits, row + 2 * x, sizeof bits);
            out[x * stride] = imath_half_to_float(bits);
        } else {
            std::memcpy(out + x * stride, row + 4 * x, sizeof(float));
        }
    }
}

}  // namespace

struct ZipBlocks::Impl {
    explicit Impl(std::shared_ptr<const InputFile> opened) : bytes(std::move(opened)) {}
    ~Impl() {
        if (file != nullptr) exr_finish(&file);
    }

    /// `out` has a pointer for each stored channel: to its first pixel of these rows, or null when it is not wanted.
    bool read_block(int index, int y, std::span<float* const> out, std::size_t stride, Workspace& work) const {
        const StoredPart& part = *parts[static_cast<std::size_t>(index)];
        const auto rows = static_cast<std::size_t>(std::min(part.block_rows, part.height - y));
        exr_chunk_info_t chunk{};
        if (exr_read_scanline_chunk_info(file, index, part.top + y, &chunk) != EXR_ERR_SUCCESS ||
            chunk.unpacked_size != part.row_bytes * rows || chunk.packed_size > chunk.unpacked_size)
            return false;
        work.packed.resize(chunk.packed_size);
        if (exr_read_chunk(file, index, &chunk, work.packed.data()) != EXR_ERR_SUCCESS) return false;
        const bool deflated = chunk.packed_size < chunk.unpacked_size;  // else it is stored as it is
        if (deflated) {
            work.inflated.resize(chunk.unpacked_size);
            if (libdeflate_zlib_decompress(work.decompressor.get(), work.packed.data(), work.packed.size(),
                                           work.inflated.data(), work.inflated.size(), nullptr) != LIBDEFLATE_SUCCESS)
                return false;
        }
        PredictedBytes predicted(deflated ? std::span<const std::uint8_t>(work.inflated)
                                          : std::span<const std::uint8_t>{});
        const std::uint8_t* plain = work.packed.data();
        for (std::size_t row = 0; row < rows; ++row) {
            for (std::size_t c = 0; c < part.channels.size(); ++c) {
                const StoredChannel& channel = part.channels[c];
                float* const to = out[c] == nullptr ? nullptr : out[c] + row * part.width * stride;
                if (!deflated) {
                    if (to != nullptr) convert(plain, part, channel.half, to, stride);
                    plain += channel.row_bytes;
                } else if (to != nullptr) {
                    work.row.resize(channel.row_bytes);
                    predicted.take(work.row);
                    convert(work.row.data(), part, channel.half, to, stride);
                } else {
                    predicted.skip(channel.row_bytes);
                }
            }
        }
        return true;
    }

    std::shared_ptr<const InputFile> bytes;
    exr_context_t file = nullptr;
    std::vector<std::optional<StoredPart>> parts;
    Workspaces<Workspace> workspaces;
};

ZipBlocks::ZipBlocks(std::shared_ptr<const InputFile> file, std::span<const Part> parts)
    : impl_(std::make_unique<Impl>(std::move(file))) {
    exr_context_initializer_t how = EXR_DEFAULT_CONTEXT_INITIALIZER;
    how.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    how.flags = EXR_CONTEXT_FLAG_SILENT_HEADER_PARSE | EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
    how.user_data = const_cast<InputFile*>(impl_->bytes.get());
    how.size_fn = [](exr_const_context_t, void* from) {
        return static_cast<std::int64_t>(static_cast<const InputFile*>(from)->size());
    };
    how.read_fn = [](exr_const_context_t, void* from, void* to, std::uint64_t size, std::uint64_t offset,
                     exr_stream_error_func_ptr_t) -> std::int64_t {
        try {
            return static_cast<std::int64_t>(static_cast<const InputFile*>(from)->read_at(offset, to, size));
        } catch (const Error&) { return -1; }  // no exception may pass through a library in C
    };
    if (exr_start_read(&impl_->file, impl_->bytes->path().c_str(), &how) != EXR_ERR_SUCCESS) return;
    int count = 0;
    exr_get_count(impl_->file, &count);
    if (static_cast<std::size_t>(count) != parts.size()) return;
    for (int part = 0; part < count; ++part)
        impl_->parts.push_back(list(impl_->file, part, parts[static_cast<std::size_t>(part)]));
}

ZipBlocks::~ZipBlocks() = default;

bool ZipBlocks::read(int part, std::span<const BlockChannel> channels, int y_begin, int y_end, std::size_t stride) {
    if (static_cast<std::size_t>(part) >= impl_->parts.size() || !impl_->parts[static_cast<std::size_t>(part)])
        return false;
    const StoredPart& stored = *impl_->parts[static_cast<std::size_t>(part)];
    if (y_begin < 0 || y_begin >= y_end || y_end > stored.height) return false;
    if (y_begin % stored.block_rows != 0 || (y_end % stored.block_rows != 0 && y_end != stored.height)) return false;
    std::vector<float*> out(stored.channels.size());
    for (const auto& channel : channels) {
        const auto found = std::ranges::find(stored.channels, channel.name, &StoredChannel::name);
        const std::size_t pixels = stored.width * static_cast<std::size_t>(y_end - y_begin);
        if (found == stored.channels.end() || found->half != channel.half ||
            found->whole_numbers != channel.whole_numbers || channel.out.size() < (pixels - 1) * stride + 1)
            return false;
        out[static_cast<std::size_t>(found - stored.channels.begin())] = channel.out.data();
    }
    const int blocks = (y_end - y_begin + stored.block_rows - 1) / stored.block_rows;
    std::atomic<int> good = 0;
    const auto read_some = [&](std::int64_t first, std::int64_t last) {
        auto workspace = impl_->workspaces.borrow();
        for (auto block = first; block < last; ++block) {
            const int row = static_cast<int>(block) * stored.block_rows;
            std::vector<float*> rows = out;
            for (float*& pixels : rows)
                if (pixels != nullptr) pixels += static_cast<std::size_t>(row) * stored.width * stride;
            if (impl_->read_block(part, y_begin + row, rows, stride, *workspace)) ++good;
        }
        impl_->workspaces.give_back(std::move(workspace));
    };
    OIIO::parallel_for_chunked(0, blocks, 1, read_some);
    return good == blocks;
}

}  // namespace wrinkle::io
