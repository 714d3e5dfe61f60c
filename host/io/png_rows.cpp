#include "io/png_rows.h"

#include <OpenImageIO/parallel.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <new>
#include <string_view>
#include <vector>

#include "io/provenance.h"
#include "io/srgb_bytes.h"

namespace wrinkle::io {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kChunkRows = 16;  // deflated on their own, one core each
constexpr int kLevel = 1;                 // with a filter it packs better than level 6 does without
constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);

void append_number(Bytes& out, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(number >> shift));
}

/// PNG's fourth filter: each byte as its difference from the neighbour (left, above, above left) that a plane through
/// the three comes nearest to.
void filter(const Bytes& row, const Bytes& above, std::size_t pixel_bytes, std::uint8_t* out) {
    constexpr std::uint8_t paeth = 4;
    *out++ = paeth;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const int a = i < pixel_bytes ? 0 : row[i - pixel_bytes], b = above[i];
        const int c = i < pixel_bytes ? 0 : above[i - pixel_bytes];
        const int to_a = std::abs(b - c), to_b = std::abs(a - c), to_c = std::abs(a + b - 2 * c);
        const int nearest = to_a <= to_b && to_a <= to_c ? a : to_b <= to_c ? b : c;
        out[i] = static_cast<std::uint8_t>(row[i] - nearest);
    }
}

/// Rows that were deflated together, and what the checksum of the whole stream needs of them.
struct Chunk {
    Bytes packed;
    uLong adler = 0;
    std::size_t bytes = 0;
};

/// Ends at a whole byte, and refers to nothing before it, so that such streams may follow each other.
void deflate_alone(const Bytes& in, Chunk& out) {
    z_stream stream{};
    constexpr int raw = -15, memory = 8;
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, raw, memory, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
    out.packed.resize(deflateBound(&stream, static_cast<uLong>(in.size())) + 16);
    stream.next_in = const_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(in.size());
    stream.next_out = out.packed.data();
    stream.avail_out = static_cast<uInt>(out.packed.size());
    deflate(&stream, Z_SYNC_FLUSH);
    out.packed.resize(out.packed.size() - stream.avail_out);
    deflateEnd(&stream);
    out.adler = adler32(adler32(0, nullptr, 0), in.data(), static_cast<uInt>(in.size()));
    out.bytes = in.size();
}

}  // namespace

struct PngRows::Impl {
    void append(std::string_view type, const Bytes& data) {
        Bytes chunk;
        append_number(chunk, static_cast<std::uint32_t>(data.size()));
        chunk.insert(chunk.end(), type.begin(), type.end());
        chunk.insert(chunk.end(), data.begin(), data.end());
        append_number(chunk, static_cast<std::uint32_t>(
                                 crc32(crc32(0, nullptr, 0), chunk.data() + 4, static_cast<uInt>(chunk.size() - 4))));
        file.write(chunk.data(), chunk.size());
    }

    void begin(const std::string& provenance) {
        file.write(kSignature.data(), kSignature.size());
        Bytes head;
        append_number(head, size.width);
        append_number(head, size.height);
        const std::uint8_t grey = 0, rgb = 2;
        head.insert(head.end(), {static_cast<std::uint8_t>(8 * sample_bytes), channels == 1 ? grey : rgb, 0, 0, 0});
        append("IHDR", head);
        if (encoding == PngEncoding::srgb) append("sRGB", {0});
        if (!provenance.empty()) {
            Bytes text(kProvenance, kProvenance + sizeof kProvenance);  // with the 0 that ends the keyword
            text.insert(text.end(), provenance.begin(), provenance.end());
            append("tEXt", text);
        }
        append("IDAT", {0x78, 0x01});  // how a zlib stream begins: deflate, windows of 32 KiB, the fastest level
    }

    void encode(const PlaneRows& rows, std::uint32_t y, Bytes& out) const {
        out.resize(row_bytes());
        for (std::size_t c = 0; c < channels; ++c) {
            const float* row = rows.row(c, y);
            std::uint8_t* to = out.data() + c * sample_bytes;
            for (std::size_t x = 0; x < size.width; ++x, to += channels * sample_bytes) {
                if (sample_bytes == 1 && encoding == PngEncoding::srgb) {
                    *to = srgb_byte(std::isnan(row[x]) ? 0 : row[x] * factor);
                } else if (sample_bytes == 1) {
                    *to = static_cast<std::uint8_t>(png_value(row[x], encoding, factor) * 255 + 0.5f);
                } else {
                    const auto value = static_cast<std::uint16_t>(png_value(row[x], encoding, factor) * 65535 + 0.5f);
                    to[0] = static_cast<std::uint8_t>(value >> 8), to[1] = static_cast<std::uint8_t>(value);
                }
            }
        }
    }

    std::size_t row_bytes() const { return size.width * channels * sample_bytes; }

    DescriptorProxy& file;
    Size size;
    std::size_t channels, sample_bytes;
    PngEncoding encoding;
    float factor;
    Bytes above;  ///< the last row of those before
    uLong adler = adler32(0, nullptr, 0);
    std::vector<Chunk> chunks{};
};

PngRows::PngRows(DescriptorProxy& file, Size size, std::size_t channels, const ImageOptions& options)
    : impl_(new Impl{.file = file,
                     .size = size,
                     .channels = channels,
                     .sample_bytes = options.png_bits == 16 ? std::size_t{2} : std::size_t{1},
                     .encoding = options.png,
                     .factor = static_cast<float>(std::exp2(options.exposure)),
                     .above = {}}) {
    impl_->above.assign(impl_->row_bytes(), 0);
    impl_->begin(options.provenance);
}

PngRows::~PngRows() = default;

bool PngRows::write(const PlaneRows& rows) {
    Impl& impl = *impl_;
    if (rows.count == 0) return true;
    const std::uint32_t chunks = (rows.count + kChunkRows - 1) / kChunkRows;
    impl.chunks.resize(std::max<std::size_t>(impl.chunks.size(), chunks));
    const auto pack_some = [&](std::int64_t from, std::int64_t to) {
        Bytes row, above, filtered;
        for (auto chunk = from; chunk < to; ++chunk) {
            const std::uint32_t first = static_cast<std::uint32_t>(chunk) * kChunkRows;
            const std::uint32_t end = std::min(first + kChunkRows, rows.count);
            if (first == 0)
                above = impl.above;
            else
                impl.encode(rows, first - 1, above);
            filtered.resize((impl.row_bytes() + 1) * (end - first));
            for (std::uint32_t y = first; y < end; ++y) {
                impl.encode(rows, y, row);
                filter(row, above, impl.channels * impl.sample_bytes,
                       filtered.data() + (impl.row_bytes() + 1) * (y - first));
                std::swap(row, above);
            }
            deflate_alone(filtered, impl.chunks[static_cast<std::size_t>(chunk)]);
        }
    };
    OIIO::parallel_for_chunked(0, chunks, 1, pack_some);
    for (std::uint32_t c = 0; c < chunks; ++c) {
        const Chunk& chunk = impl.chunks[c];
        impl.append("IDAT", chunk.packed);
        impl.adler = adler32_combine(impl.adler, chunk.adler, static_cast<z_off_t>(chunk.bytes));
    }
    impl.encode(rows, rows.count - 1, impl.above);
    return impl.file.failure() == 0;
}

bool PngRows::finish() {
    Bytes end{3, 0};  // an empty last block
    append_number(end, static_cast<std::uint32_t>(impl_->adler));
    impl_->append("IDAT", end);
    impl_->append("IEND", {});
    return impl_->file.failure() == 0;
}

}  // namespace wrinkle::io
