#include "io/image_writer.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/parallel.h>

#include <fmt/format.h>
#include <half.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "base/atomic_file.h"
#include "base/names.h"
#include "io/descriptor_proxy.h"
#include "io/image_open.h"
#include "io/metadata_data.h"
#include "io/provenance.h"
#include "io/reason.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr std::size_t scratch_floats = 16u << 20;  // at most 64 MiB of rows are interleaved at a time
constexpr float largest_half = 65504;

/// Whether an attribute describes how a file is stored, rather than the picture in it.
bool describes_storage(std::string_view name) {
    if (name == "oiio:ColorSpace") return false;
    if (name.starts_with("oiio:") || name.starts_with("openexr:")) return true;
    for (const std::string_view own : {"compression", "name", "type", "channels", "multiView", "view"}) {
        if (name == own) return true;
    }
    return false;
}

/// Whether a channel stays 32-bit in a half file: ids of Cryptomatte, and those that the caller names.
bool keeps_bits(const std::string& channel, const ImageOptions& options) {
    return options.full.contains(channel) || contains_ignoring_case(channel, "crypto");
}

const char* name_of(Compression compression) {
    const char* const names[] = {"zip", "zips", "dwaa", "none"};
    return names[static_cast<int>(compression)];
}

OIIO::ImageSpec exr_spec(Size size, const std::vector<std::string>& channels, const ImageOptions& options) {
    OIIO::ImageSpec spec(static_cast<int>(size.width), static_cast<int>(size.height), static_cast<int>(channels.size()),
                         options.half ? OIIO::TypeHalf : OIIO::TypeFloat);
    spec.channelnames = channels;
    if (options.half || !options.whole.empty()) {
        for (const auto& channel : channels)
            spec.channelformats.push_back(options.whole.contains(channel)                 ? OIIO::TypeUInt32
                                          : options.half && !keeps_bits(channel, options) ? OIIO::TypeHalf
                                                                                          : OIIO::TypeFloat);
    }
    if (options.window) {
        spec.x = options.window->x, spec.y = options.window->y;
        spec.full_width = static_cast<int>(options.window->display.width);
        spec.full_height = static_cast<int>(options.window->display.height);
    }
    for (const auto& attribute : options.metadata.data().list) {
        if (!describes_storage(attribute.name().string())) spec.extra_attribs.add_or_replace(attribute);
    }
    spec.attribute("compression", name_of(options.compression));
    return spec;
}

float srgb(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

}  // namespace

float png_value(float value, PngEncoding encoding, float factor) {
    if (std::isnan(value)) return 0;
    if (encoding == PngEncoding::normal) return std::clamp((value + 1) / 2, 0.0f, 1.0f);
    if (encoding == PngEncoding::linear) return std::clamp(value, 0.0f, 1.0f);
    return srgb(std::clamp(value * factor, 0.0f, 1.0f));
}

struct ImageWriter::Impl {
    Impl(const std::filesystem::path& path, Size size, std::vector<std::string> channels, ImageOptions given)
        : size(size), names(std::move(channels)), options(std::move(given)), file(path), proxy(file.descriptor()) {
        const auto extension = lower(path.extension().string());
        png = extension == ".png";
        const FrameWindow window = options.window.value_or(FrameWindow{0, 0, size});
        if (png)
            stored = {static_cast<std::uint32_t>(-window.x), static_cast<std::uint32_t>(-window.y), window.display};
        else
            stored = {0, 0, size};
        auto spec = png ? OIIO::ImageSpec(static_cast<int>(stored.size.width), static_cast<int>(stored.size.height),
                                          static_cast<int>(names.size()),
                                          options.png_bits == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8)
                        : exr_spec(size, names, options);
        file_row = spec.y;
        if (!options.provenance.empty()) spec.attribute(io::kProvenance, options.provenance);
        if (png && options.png == PngEncoding::srgb) spec.attribute("oiio:ColorSpace", "sRGB");
        for (const auto& name : names) {
            halves.push_back(!png && options.half && !keeps_bits(name, options) && !options.whole.contains(name));
            keep_finite.push_back(halves.back());
        }
        exposure = static_cast<float>(std::exp2(options.exposure));
        output = OIIO::ImageOutput::create(png ? "png" : "openexr", &proxy);
        if (!output || !output->set_ioproxy(&proxy)) {
            throw Error(fmt::format("cannot write {}: this OpenImageIO does not write {} files{}", path.string(),
                                    extension, io::reason(OIIO::geterror())));
        }
        if (!output->open(path.string(), spec)) fail();
    }

    ~Impl() {
        if (!output) return;
        proxy.discard();  // the file will be deleted, so close() need not write anything
        const std::vector<float> blank(png ? stored.size.width * names.size() : 0);
        for (auto row = next_row; png && row < stored.size.height;
             ++row)  // libpng prints a complaint about missing rows
            output->write_scanline(static_cast<int>(row), 0, OIIO::TypeFloat, blank.data());
        output->close();
    }

    [[noreturn]] void fail() {
        const auto why = output->geterror();
        const auto text =
            proxy.failure() != 0 ? std::string(std::strerror(proxy.failure())) : "the image" + io::reason(why);
        throw Error(file.failure(text));
    }

    float encode(float value, std::size_t channel) const {
        if (!png) {
            return keep_finite[channel] && std::isfinite(value) ? std::clamp(value, -largest_half, largest_half)
                                                                : value;
        }
        return png_value(value, options.png == PngEncoding::srgb && channel == 3 ? PngEncoding::linear : options.png,
                         exposure);
    }

    /// Rows of the planes, counted from the planes' first, become interleaved pixels.
    void interleave(std::span<const float* const> planes, std::size_t first, std::size_t rows) {
        const std::size_t channels = planes.size(), width = stored.size.width;
        scratch.resize(std::max(scratch.size(), rows * width * channels));
        OIIO::parallel_for(std::int64_t{0}, static_cast<std::int64_t>(rows), [&](std::int64_t row) {
            const auto at = static_cast<std::size_t>(row);
            for (std::size_t channel = 0; channel < channels; ++channel) {
                const float* in = planes[channel] + (first + at) * size.width + stored.left;
                float* out = scratch.data() + at * width * channels + channel;
                for (std::size_t x = 0; x < width; ++x) out[x * channels] = encode(in[x], channel);
            }
        });
    }

    /// The interleaved floats as the file stores them, where integers are among them: those are bits already.
    const void* native(std::size_t pixels) {
        packed.clear();
        const auto append = [&](const auto& value) {
            const auto* bytes = reinterpret_cast<const std::byte*>(&value);
            packed.insert(packed.end(), bytes, bytes + sizeof value);
        };
        for (std::size_t i = 0; i < pixels * names.size(); ++i)
            if (halves[i % names.size()])
                append(half(scratch[i]));
            else
                append(scratch[i]);
        return packed.data();
    }

    bool write(std::uint32_t row, std::uint32_t rows) {
        const bool integers = !png && !options.whole.empty();
        const void* pixels = integers ? native(std::size_t{rows} * stored.size.width) : scratch.data();
        const int first = file_row + static_cast<int>(row);
        return output->write_scanlines(first, first + static_cast<int>(rows), 0,
                                       integers ? OIIO::TypeUnknown : OIIO::TypeFloat, pixels);
    }

    /// The part of the frame that the file holds.
    struct Stored {
        std::uint32_t left = 0, top = 0;
        Size size;
    };

    Size size;
    std::vector<std::string> names;
    ImageOptions options;
    bool png = false;
    float exposure = 1;
    std::vector<bool> keep_finite;
    std::vector<bool> halves;  // which channels an EXR file stores in 16 bits
    Stored stored;
    int file_row = 0;            // number of the first row in the file
    std::uint32_t next_row = 0;  // of the stored ones
    std::uint32_t next_frame_row = 0;
    std::vector<float> scratch;
    std::vector<std::byte> packed;
    AtomicFile file;  // declared in this order, so that output goes before proxy, and proxy before file
    io::DescriptorProxy proxy;
    std::unique_ptr<OIIO::ImageOutput> output;
};

ImageWriter::ImageWriter(const std::filesystem::path& file, Size size, std::vector<std::string> channels,
                         ImageOptions options) {
    const auto extension = lower(file.extension().string());
    if (extension != ".exr" && extension != ".png") {
        throw Error(fmt::format("cannot write {}: \"{}\" is not a format wrinkle writes; use .exr or .png",
                                file.string(), extension));
    }
    constexpr std::size_t most_of_png = 4;
    if (extension == ".png" && channels.size() > most_of_png) {
        throw Error(fmt::format("cannot write {}: {} channels are more than the {} that a PNG holds; use .exr",
                                file.string(), channels.size(), most_of_png));
    }
    if (size.width == 0 || size.height == 0 || channels.empty()) {
        throw Error(fmt::format("cannot write {}: {}x{} with {} channels is not a picture", file.string(), size.width,
                                size.height, channels.size()));
    }
    impl_ = std::make_unique<Impl>(file, size, std::move(channels), std::move(options));
}

ImageWriter::~ImageWriter() = default;
ImageWriter::ImageWriter(ImageWriter&&) noexcept = default;
ImageWriter& ImageWriter::operator=(ImageWriter&&) noexcept = default;

void ImageWriter::write_rows(std::uint32_t row_begin, std::uint32_t row_end, std::span<const float* const> planes) {
    if (row_begin != impl_->next_frame_row || row_end < row_begin || row_end > impl_->size.height ||
        planes.size() != impl_->names.size()) {
        throw Error(
            impl_->file.failure(fmt::format("rows {} to {} of {} channels came where row {} of {} was due", row_begin,
                                            row_end, planes.size(), impl_->next_row, impl_->names.size())));
    }
    impl_->next_frame_row = row_end;
    const auto& [left, top, size] = impl_->stored;
    const std::uint32_t begin = std::max(row_begin, top), end = std::min(row_end, top + size.height);
    const std::size_t row_floats = size.width * planes.size();
    constexpr std::uint32_t zip_block = 16;
    const auto rows = std::max(static_cast<std::uint32_t>(scratch_floats / row_floats) / zip_block, 1u) * zip_block;
    for (std::uint32_t row = begin; row < end; row += rows) {
        const auto count = std::min(rows, end - row);
        impl_->interleave(planes, row - row_begin, count);
        if (!impl_->write(row - top, count) || impl_->proxy.failure() != 0) impl_->fail();
        impl_->next_row = row - top + count;
    }
}

void ImageWriter::complete() {
    if (!impl_->output) return;
    if (impl_->next_frame_row != impl_->size.height) {
        throw Error(impl_->file.failure(
            fmt::format("only {} of {} rows were written", impl_->next_frame_row, impl_->size.height)));
    }
    const bool closed = impl_->output->close();
    if (!closed || impl_->proxy.failure() != 0) impl_->fail();
    impl_->output.reset();
    impl_->file.sync();
}

void ImageWriter::finish() {
    complete();
    impl_->file.commit();
}

}  // namespace wrinkle
