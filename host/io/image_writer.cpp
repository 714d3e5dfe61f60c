#include "io/image_writer.h"

#include <OpenImageIO/imageio.h>

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/atomic_file.h"
#include "base/names.h"
#include "io/descriptor_proxy.h"
#include "io/exr_blocks.h"
#include "io/image_open.h"
#include "io/metadata_data.h"
#include "io/oiio_rows.h"
#include "io/png_rows.h"
#include "io/provenance.h"
#include "io/reason.h"
#include "io/srgb_bytes.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

/// A whole number of blocks and chunks, more than there are cores: what of a picture lies packed in memory at a time.
constexpr std::uint32_t kRowsAtATime = 512;

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
    if (!options.provenance.empty()) spec.attribute(io::kProvenance, options.provenance);
    return spec;
}

}  // namespace

float png_value(float value, PngEncoding encoding, float factor) {
    if (std::isnan(value)) return 0;
    if (encoding == PngEncoding::normal) return std::clamp((value + 1) / 2, 0.0f, 1.0f);
    if (encoding == PngEncoding::linear) return std::clamp(value, 0.0f, 1.0f);
    return io::srgb(std::clamp(value * factor, 0.0f, 1.0f));
}

struct ImageWriter::Impl {
    Impl(const std::filesystem::path& path, Size size, std::vector<std::string> channels, ImageOptions given)
        : size(size), names(std::move(channels)), options(std::move(given)), file(path), proxy(file.descriptor()) {
        png = lower(path.extension().string()) == ".png";
        const FrameWindow window = options.window.value_or(FrameWindow{0, 0, size});
        if (png)
            stored = {static_cast<std::uint32_t>(-window.x), static_cast<std::uint32_t>(-window.y), window.display};
        else
            stored = {0, 0, size};
        const bool alpha = names.size() == 2 || names.size() == 4;
        if (png && !alpha)
            sink = std::make_unique<io::PngRows>(proxy, stored.size, names.size(), options);
        else if (png || options.compression == Compression::dwaa)
            leave_to_oiio(path);
        else
            write_blocks(path);
    }

    ~Impl() {
        proxy.discard();  // the file will be deleted, so what the sink ends with need not be written
        sink.reset();
        if (output) output->close();
    }

    std::unique_ptr<OIIO::ImageOutput> opened(const std::filesystem::path& path, const OIIO::ImageSpec& spec,
                                              io::DescriptorProxy& to) const {
        auto opened = OIIO::ImageOutput::create(png ? "png" : "openexr", &to);
        if (!opened || !opened->set_ioproxy(&to)) {
            throw Error(fmt::format("cannot write {}: this OpenImageIO does not write {} files{}", path.string(),
                                    path.extension().string(), io::reason(OIIO::geterror())));
        }
        if (!opened->open(path.string(), spec)) fail(to.failure(), opened->geterror());
        return opened;
    }

    void leave_to_oiio(const std::filesystem::path& path) {
        OIIO::ImageSpec spec = exr_spec(size, names, options);
        if (png) {
            spec = OIIO::ImageSpec(static_cast<int>(stored.size.width), static_cast<int>(stored.size.height),
                                   static_cast<int>(names.size()),
                                   options.png_bits == 16 ? OIIO::TypeUInt16 : OIIO::TypeUInt8);
            if (options.png == PngEncoding::srgb) spec.attribute("oiio:ColorSpace", "sRGB");
            if (!options.provenance.empty()) spec.attribute(io::kProvenance, options.provenance);
        }
        output = opened(path, spec, proxy);
        std::vector<bool> whole;
        for (const std::string& name : names) whole.push_back(!png && options.whole.contains(name));
        sink = std::make_unique<io::OiioRows>(
            *output, whole, [this](float value, std::size_t channel) { return encode(value, channel); });
    }

    /// OpenEXR writes the header, with every attribute as it is meant to be, and an empty table of offsets. It is
    /// closed then, and what it would still write goes nowhere.
    void write_blocks(const std::filesystem::path& path) {
        const OIIO::ImageSpec spec = exr_spec(size, names, options);
        io::DescriptorProxy header(file.descriptor());
        const auto writer = opened(path, spec, header);
        header.discard();
        writer->close();
        if (header.failure() != 0) fail(header.failure(), {});
        std::vector<io::BlockPlane> planes;
        for (const std::string& name : names) planes.push_back({name, is_half(name)});
        sink = std::make_unique<io::ExrBlocks>(proxy, spec.y, size, std::move(planes), options.compression);
    }

    bool is_half(const std::string& name) const {
        return !png && options.half && !keeps_bits(name, options) && !options.whole.contains(name);
    }

    [[noreturn]] void fail(int of_disk, const std::string& of_format) const {
        throw Error(
            file.failure(of_disk != 0 ? std::string(std::strerror(of_disk)) : "the image" + io::reason(of_format)));
    }
    [[noreturn]] void fail() const { fail(proxy.failure(), output ? output->geterror() : ""); }

    float encode(float value, std::size_t channel) const {
        constexpr float largest_half = 65504;
        constexpr std::size_t alpha = 3;
        if (!png)
            return is_half(names[channel]) && std::isfinite(value) ? std::clamp(value, -largest_half, largest_half)
                                                                   : value;
        return png_value(value,
                         options.png == PngEncoding::srgb && channel == alpha ? PngEncoding::linear : options.png,
                         static_cast<float>(std::exp2(options.exposure)));
    }

    /// The part of the frame that the file holds.
    struct Stored {
        std::uint32_t left = 0, top = 0;
        Size size;
    };

    Size size;
    std::vector<std::string> names;
    ImageOptions options;
    bool png = false, completed = false;
    Stored stored;
    std::uint32_t next_row = 0;  // of the frame
    AtomicFile file;             // declared in this order, so that what writes goes before proxy, and proxy before file
    io::DescriptorProxy proxy;
    std::unique_ptr<OIIO::ImageOutput> output;
    std::unique_ptr<io::RowSink> sink;
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
    Impl& impl = *impl_;
    if (row_begin != impl.next_row || row_end < row_begin || row_end > impl.size.height ||
        planes.size() != impl.names.size()) {
        throw Error(
            impl.file.failure(fmt::format("rows {} to {} of {} channels came where row {} of {} was due", row_begin,
                                          row_end, planes.size(), impl.next_row, impl.names.size())));
    }
    impl.next_row = row_end;
    const auto& [left, top, size] = impl.stored;
    const std::uint32_t begin = std::max(row_begin, top), end = std::min(row_end, top + size.height);
    std::vector<const float*> firsts(planes.size());
    for (std::uint32_t row = begin; row < end; row += kRowsAtATime) {
        const std::size_t skipped = std::size_t{row - row_begin} * impl.size.width + left;
        for (std::size_t c = 0; c < planes.size(); ++c) firsts[c] = planes[c] + skipped;
        const std::uint32_t count = std::min(kRowsAtATime, end - row);
        const bool written = impl.sink->write({firsts, impl.size.width, count});
        if (!written || impl.proxy.failure() != 0) impl.fail();
    }
}

void ImageWriter::complete() {
    Impl& impl = *impl_;
    if (impl.completed) return;
    if (impl.next_row != impl.size.height) {
        throw Error(impl.file.failure(fmt::format("only {} of {} rows were written", impl.next_row, impl.size.height)));
    }
    const bool finished = impl.sink->finish();
    if (!finished || impl.proxy.failure() != 0) impl.fail();
    impl.sink.reset();
    impl.output.reset();
    impl.completed = true;
    impl.file.sync();
}

void ImageWriter::finish() {
    complete();
    impl_->file.commit();
}

}  // namespace wrinkle
