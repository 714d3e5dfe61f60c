#include "io/montage.h"

#include <OpenImageIO/imagebufalgo.h>

#include <fmt/format.h>

#include <algorithm>

#include "io/image_writer.h"
#include "wrinkle/error.h"

namespace wrinkle {
namespace {

constexpr const char* font = "DejaVuSans";
constexpr int gap = 6, caption_height = 24, largest_text = 15, smallest_text = 5;  // pixels

/// The largest size at which `text` is no wider than `width`.
int text_size_for(const std::string& text, int width) {
    for (int size = largest_text; size > smallest_text; --size) {
        const OIIO::ROI extent = OIIO::ImageBufAlgo::text_size(text, size, font);
        if (!extent.defined())
            throw Error(fmt::format(
                "captions need the font {}; install Debian's fonts-dejavu-core, or point OPENIMAGEIO_FONTS at a folder "
                "with {}.ttf",
                font, font));
        if (extent.width() <= width) return size;
    }
    return smallest_text;
}

}  // namespace

void write_montage(const std::filesystem::path& file, std::span<const MontagePart> parts, int columns) {
    const int count = static_cast<int>(parts.size()), across = columns > 0 ? std::min(columns, count) : count;
    const int down = (count + across - 1) / across;
    const int width = static_cast<int>(parts.front().size.width), height = static_cast<int>(parts.front().size.height);
    const Size size{static_cast<std::uint32_t>(across * (width + gap) - gap),
                    static_cast<std::uint32_t>(down * (height + caption_height))};
    OIIO::ImageBuf sheet(
        OIIO::ImageSpec(static_cast<int>(size.width), static_cast<int>(size.height), 3, OIIO::TypeFloat));
    OIIO::ImageBufAlgo::fill(sheet, {1, 1, 1});
    for (int i = 0; i < count; ++i) {
        const MontagePart& part = parts[static_cast<std::size_t>(i)];
        const int left = i % across * (width + gap), top = i / across * (height + caption_height);
        sheet.set_pixels({left, left + width, top, top + height, 0, 1, 0, 3}, OIIO::TypeFloat, part.rgb.data());
        OIIO::ImageBufAlgo::render_text(sheet, left + width / 2, top + height + caption_height / 2, part.caption,
                                        text_size_for(part.caption, width), font, {0, 0, 0},
                                        OIIO::ImageBufAlgo::TextAlignX::Center, OIIO::ImageBufAlgo::TextAlignY::Center);
    }
    ImageOptions options;
    options.png = PngEncoding::linear;
    ImageWriter writer(file, size, {"R", "G", "B"}, options);
    std::vector<float> planes[3];
    for (int c = 0; c < 3; ++c) {
        planes[c].resize(std::size_t{size.width} * size.height);
        sheet.get_pixels({0, static_cast<int>(size.width), 0, static_cast<int>(size.height), 0, 1, c, c + 1},
                         OIIO::TypeFloat, planes[c].data());
    }
    const float* const rows[] = {planes[0].data(), planes[1].data(), planes[2].data()};
    writer.write_rows(0, size.height, rows);
    writer.finish();
}

}  // namespace wrinkle
