#include "io/deflate.h"

#include <isa-l/igzip_lib.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <vector>

namespace wrinkle::io {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr int kUsual = 4, kQuick = 1;  // of libdeflate; the usual one packs as zlib's level 4 does
constexpr int kQuickest = 3;           // of ISA-L
constexpr double kHardlyPacks = 0.7, kHardlyLarger = 1.01;
constexpr std::size_t kSample = 8192;  // bytes that tell, from either half of a block

struct FreeCompressor {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};
using Compressor = std::unique_ptr<libdeflate_compressor, FreeCompressor>;

std::size_t pack_by(const Compressor& compressor, Bytes block, std::span<std::uint8_t> out) {
    return libdeflate_zlib_compress(compressor.get(), block.data(), block.size(), out.data(), out.size());
}

}  // namespace

struct Deflater::Impl {
    std::size_t pack_quickest(Bytes block, std::span<std::uint8_t> out) {
        isal_deflate_stateless_init(&stream);
        stream.level = kQuickest;
        stream.level_buf = memory.data();
        stream.level_buf_size = static_cast<std::uint32_t>(memory.size());
        stream.gzip_flag = IGZIP_ZLIB;
        stream.end_of_stream = 1;
        stream.next_in = const_cast<std::uint8_t*>(block.data());  // it is only read
        stream.avail_in = static_cast<std::uint32_t>(block.size());
        stream.next_out = out.data();
        stream.avail_out = static_cast<std::uint32_t>(out.size());
        return isal_deflate_stateless(&stream) == COMP_OK ? stream.total_out : 0;
    }

    std::size_t pack(Bytes block, std::span<std::uint8_t> out) {
        if (block.size() < 8 * kSample) return pack_by(usual, block, out);
        std::array<std::uint8_t, 2 * kSample> sample{};
        std::array<std::uint8_t, 2 * sample.size()> packed{};
        std::ranges::copy(block.subspan(block.size() / 4, kSample), sample.begin());
        std::ranges::copy(block.subspan(block.size() / 4 * 3, kSample), sample.begin() + kSample);
        const auto least = static_cast<double>(pack_by(usual, sample, packed));
        if (static_cast<double>(pack_quickest(sample, packed)) <= kHardlyLarger * least)
            return pack_quickest(block, out);
        return pack_by(least > kHardlyPacks * sample.size() ? quick : usual, block, out);
    }

    Compressor usual{libdeflate_alloc_compressor(kUsual)}, quick{libdeflate_alloc_compressor(kQuick)};
    isal_zstream stream{};
    std::vector<std::uint8_t> memory = std::vector<std::uint8_t>(ISAL_DEF_LVL3_DEFAULT);
};

Deflater::Deflater() : impl_(std::make_unique<Impl>()) {}
Deflater::~Deflater() = default;

std::size_t Deflater::pack(std::span<const std::uint8_t> block, std::span<std::uint8_t> out) {
    return impl_->pack(block, out);
}

}  // namespace wrinkle::io
