#include "io/image_open.h"

#include <fmt/format.h>
#include <webp/decode.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "base/claim.h"
#include "io/exr_header.h"
#include "io/image_format.h"
#include "io/input_proxy.h"
#include "io/reason.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

/// Whether a PNG ends before its last chunk. It is checked here since libpng would print its own message to stderr.
bool is_cut_png(const InputFile& file) {
    constexpr std::size_t kSignature = 8, kChecksum = 4;
    std::array<unsigned char, 8> head{};  // the length and type of a chunk
    for (std::uint64_t at = kSignature; file.read_at(at, head.data(), head.size()) == head.size();) {
        if (std::string_view(reinterpret_cast<const char*>(head.data()) + 4, 4) == "IEND") return false;
        std::uint32_t length = 0;
        for (std::size_t i = 0; i < 4; ++i) length = length << 8 | head[i];
        at += head.size() + length + kChecksum;
    }
    return true;
}

/// What the file's first picture would take as floats, within its window or the display's, and what OpenImageIO takes
/// to read it: 64 rows at a time, twice, however few there are. A file of another kind than EXR, which is judged
/// before, is compressed at most as well as deflate does it, and its bytes may become floats.
void check_size(const OIIO::ImageSpec& spec, const InputFile& file) {
    constexpr double kRowsAtATime = 2 * 64, kSmallDisplay = 256 << 20;
    const double pixel = double{sizeof(float)} * spec.nchannels;
    const auto claim = [&](int width, int height, double bytes) {
        check_claim(file.name(), {fmt::format("a picture of {}x{} pixels", width, height), bytes, file.size(),
                                  kDeflate * sizeof(float)});
    };
    claim(spec.width, spec.height, pixel * spec.width * spec.height * spec.depth);
    claim(spec.width, spec.height, pixel * spec.width * kRowsAtATime);
    // A small picture within a large display is sound, up to a point.
    const double display = pixel * spec.full_width * spec.full_height;
    if (display > kSmallDisplay) claim(spec.full_width, spec.full_height, display);
}

std::uint32_t word_of(const std::array<unsigned char, 148>& header, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t i = 4; i-- > 0;) word = word << 8 | header[at + i];
    return word;
}

/// Throws Error for a DDS file that cannot be read as it is. What is missing of one would be read as 0.
void check_dds(const InputFile& file) {
    std::array<unsigned char, 148> header{};
    if (file.read_at(0, header.data(), header.size()) < 128) return;
    constexpr std::size_t height_at = 12, width_at = 16, flags_at = 80, code_at = 84, bits_at = 88, dxgi_at = 128;
    constexpr std::uint32_t has_code = 4;
    const std::uint64_t width = word_of(header, width_at), height = word_of(header, height_at);
    const std::string_view code(reinterpret_cast<const char*>(header.data()) + code_at, 4);
    const bool coded = (word_of(header, flags_at) & has_code) != 0;
    if (coded && code == "DX10")
        throw Error(
            fmt::format("{}: a DDS of the kind DX10 (DXGI format {}), which OpenImageIO does not read; save it as "
                        "PNG, TIFF or EXR, or as a DDS without that header",
                        file.name(), word_of(header, dxgi_at)));
    const bool small_blocks = code == "DXT1" || code == "ATI1" || code == "BC4U" || code == "BC4S";
    const std::uint64_t bytes = coded ? (width + 3) / 4 * ((height + 3) / 4) * (small_blocks ? 8 : 16)
                                      : width * height * word_of(header, bits_at) / 8;
    if (file.size() < 128 + bytes)
        throw Error(fmt::format("{}: the DDS is truncated: {} bytes of at least {}; was it still being written?",
                                file.name(), file.size(), 128 + bytes));
}

/// Throws Error for a DPX file that is shorter than it says, or than its user data, or too small for its rows:
/// OpenImageIO reads what is missing as zeros, and takes memory for a row as it opens a file.
void check_dpx(const InputFile& file) {
    constexpr std::size_t size_at = 16, user_data_at = 32, width_at = 772, height_at = 776;
    std::array<unsigned char, height_at + 4> header{};
    if (file.read_at(0, header.data(), header.size()) < header.size()) return;
    const bool big_endian = header[0] == 'S';
    const auto word = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value = value << 8 | header[at + (big_endian ? i : 3 - i)];
        return value;
    };
    for (const std::uint32_t said : {word(size_at), word(user_data_at)}) {
        const bool is_set = said != UINT32_MAX;
        if (is_set && file.size() < said)
            throw Error(fmt::format("{}: the DPX is truncated: {} bytes of {}; was it still being written?",
                                    file.name(), file.size(), said));
    }
    constexpr double kPixel = 4 * sizeof(float);
    const std::uint32_t width = word(width_at), height = word(height_at);
    check_claim(file.name(), {fmt::format("a picture of {}x{} pixels", width, height),
                              kPixel * width * std::max(height, 1U), file.size(), kDeflate * sizeof(float)});
}

/// Throws Error for a WebP file that is too small for what it claims: OpenImageIO decodes it as it opens it.
void check_webp(const InputFile& file) {
    std::array<std::uint8_t, 4096> head{};  // what its dimensions stand in
    int width = 0, height = 0;
    if (WebPGetInfo(head.data(), file.read_at(0, head.data(), head.size()), &width, &height) == 0) return;
    constexpr double kPixel = 4;  // bytes
    check_claim(file.name(), {fmt::format("a picture of {}x{} pixels", width, height), kPixel * width * height,
                              file.size(), kDeflate * kPixel});
}

}  // namespace

OpenImage::OpenImage(const std::filesystem::path& file, const OIIO::ImageSpec& options)
    : OpenImage(std::make_shared<const InputFile>(file, "an image"), options) {}

OpenImage::OpenImage(std::shared_ptr<const InputFile> file, const OIIO::ImageSpec& options) : file_(std::move(file)) {
    const std::string name = file_->name();
    if (file_->size() == 0)
        throw Error(fmt::format("{}: the file is empty (0 bytes); was it still being written?", name));
    const auto format = image_format(*file_);
    if (format.empty()) throw Error(fmt::format("{}: not an image; {} was expected", name, kImageFormats));
    if (format == "png" && is_cut_png(*file_))
        throw Error(fmt::format("{}: the PNG is truncated; was it still being written?", name));
    if (format == "openexr") check_exr_header(file_);
    if (format == "jpeg") {  // OpenImageIO's reader takes files of its own, or memory
        bytes_ = std::make_unique<std::string>(file_->read_all());
        proxy_ = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes_->data(), bytes_->size());
    } else {
        proxy_ = std::make_unique<InputProxy>(file_);
    }
    if (format == "dds") check_dds(*file_);
    if (format == "dpx") check_dpx(*file_);
    if (format == "webp") check_webp(*file_);
    OIIO::geterror();  // forgets messages of earlier calls
    input_ = OIIO::ImageInput::create(std::string(format));
    OIIO::ImageSpec spec, with_proxy = options;
    OIIO::Filesystem::IOProxy* const proxy = proxy_.get();
    with_proxy.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
    if (!input_ || !input_->open(name, spec, with_proxy)) {
        const std::string why = input_ ? input_->geterror() : OIIO::geterror();
        if (why.find("Subsampled") != std::string::npos)
            throw Error(
                fmt::format("{}: luminance and subsampled chroma, which OpenImageIO does not read; save it as RGB{}",
                            name, reason(why)));
        throw Error(fmt::format("{}: not an image, or damaged{}", name, reason(why)));
    }
    if (std::min({spec.width, spec.height, spec.full_width, spec.full_height, spec.nchannels}) < 1)
        throw Error(fmt::format("{}: {} x {} pixels of {} channels: there is nothing in it", name, spec.width,
                                spec.height, spec.nchannels));
    if (format != "openexr") check_size(spec, *file_);
}

}  // namespace wrinkle::io
