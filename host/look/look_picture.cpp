#include "look/look_picture.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>
#include <webp/encode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "io/descriptor_proxy.h"
#include "io/image_writer.h"
#include "io/png_rows.h"
#include "wrinkle/error.h"
#include "wrinkle/gbuffer.h"

namespace wrinkle {

const std::vector<MarkedColor> kMarkedColors{
    {Marked::invalid, "#3a3a44", "background, or no normal: passed through"},
    {Marked::back_facing, "#3f7fd0", "faced away: turned to the viewer"},
    {Marked::no_uv_derivative, "#e0a030", "no usable neighbour: layers on the UV pass are zero"},
    {Marked::overflow, "#d04040", "a gradient too large for a float"},
    {Marked::picture_hole, "#c040c0", "the picture was not finite"},
};

namespace {

/// A picture: three planes, and how files hold them.
struct Picture {
    std::array<const float*, 3> planes{};
    PngEncoding encoding = PngEncoding::linear;
    std::array<std::vector<float>, 3> made{};  ///< planes of its own
    bool keeps_brightest = false;              ///< when it shrinks: a single mark is no mean of its neighbours
};

/// "N.x" with the parts of `axes`; nothing where one is missing.
std::optional<Picture> parts_of(const WholePlanes& planes, const std::string& name, const char* axes,
                                PngEncoding encoding) {
    Picture out{.encoding = encoding};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto plane = planes.find(fmt::format("{}.{}", name, axes[k]));
        if (plane == planes.end()) return {};
        out.planes[k] = plane->second.data();
    }
    return out;
}

Picture in_grey(std::vector<float> values) {
    Picture out;
    out.made[0] = std::move(values);
    out.planes.fill(out.made[0].data());
    return out;
}

Picture in_colors(const std::vector<float>& marked) {
    std::array<float, 3> colors[32]{};
    for (int bits = 1; bits < 32; ++bits)
        for (const MarkedColor& mark : kMarkedColors)
            if ((bits & mark.bit) != 0) {
                const long rgb = std::strtol(mark.color + 1, nullptr, 16);
                for (std::size_t k = 0; k < 3; ++k)
                    colors[bits][k] = static_cast<float>(rgb >> (16 - 8 * k) & 255) / 255.0f;
            }
    Picture out{.keeps_brightest = true};
    for (std::size_t k = 0; k < 3; ++k) {
        out.made[k].resize(marked.size());
        for (std::size_t i = 0; i < marked.size(); ++i) out.made[k][i] = colors[static_cast<int>(marked[i]) & 31][k];
        out.planes[k] = out.made[k].data();
    }
    return out;
}

std::optional<Picture> picture_of(const LookImage& image, const std::string& name) {
    const auto plane = image.out.find(name);
    if (name == "lit") return parts_of(image.out, "lit", "rgb", PngEncoding::srgb);
    if (name == "before") {
        if (image.unbumped) return parts_of(*image.unbumped, "lit", "rgb", PngEncoding::srgb);
        return image.relight == Relight::ratio ? parts_of(*image.frame, "beauty", "rgb", PngEncoding::srgb)
                                               : std::nullopt;
    }
    if (name == "normal") return parts_of(image.out, "normal", "xyz", PngEncoding::normal);
    if (name == "base_normal") return parts_of(*image.frame, "normal", "xyz", PngEncoding::normal);
    if (plane == image.out.end()) return {};
    if (name == "roughness") return in_grey(plane->second);
    if (name == "marked") return in_colors(plane->second);
    if (name != "condition") return {};
    constexpr float kWhite = 6;  // powers of ten
    std::vector<float> grey = plane->second;
    for (float& v : grey) v = std::log10(std::max(v, 1.0f)) / kWhite;
    return in_grey(std::move(grey));
}

/// A file that is nowhere but in memory.
class MemoryFile {
public:
    MemoryFile() : descriptor_(::memfd_create("picture", MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw Error("there is no memory for a picture");
    }
    ~MemoryFile() { ::close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    int descriptor() const { return descriptor_; }
    std::string bytes(std::size_t size) const {
        std::string out(size, '\0');
        for (std::size_t at = 0; at < size;) {
            const ssize_t count = ::pread(descriptor_, out.data() + at, size - at, static_cast<off_t>(at));
            if (count <= 0) throw Error("a picture in memory cannot be read");
            at += static_cast<std::size_t>(count);
        }
        return out;
    }

private:
    int descriptor_;
};

/// A pixel of the picture made `step` times smaller: the mean of those at (x, y) times the step, or the brightest of
/// them. At the right and lower edge, of those that there are.
std::array<float, 3> shrunk(const Picture& picture, Size size, std::uint32_t x, std::uint32_t y, std::uint32_t step) {
    std::array<float, 3> sum{}, brightest{};
    float count = 0, most = 0;
    for (std::uint32_t v = y * step; v < std::min((y + 1) * step, size.height); ++v)
        for (std::uint32_t u = x * step; u < std::min((x + 1) * step, size.width); ++u, ++count) {
            std::array<float, 3> pixel{};
            for (std::size_t k = 0; k < 3; ++k) {
                const float value = picture.planes[k][std::size_t{v} * size.width + u];
                pixel[k] = std::isfinite(value) ? value : 0;
                sum[k] += pixel[k];
            }
            if (const float light = pixel[0] + pixel[1] + pixel[2]; light > most) most = light, brightest = pixel;
        }
    if (picture.keeps_brightest) return brightest;
    for (float& value : sum) value /= count;
    return sum;
}

/// Interleaved bytes of the picture, `step` times smaller.
std::vector<std::uint8_t> bytes_of(const Picture& picture, const LookImage& image, std::uint32_t step) {
    const std::uint32_t width = (image.size.width + step - 1) / step, height = (image.size.height + step - 1) / step;
    const auto factor = static_cast<float>(std::exp2(image.exposure));
    std::vector<std::uint8_t> out;
    out.reserve(std::size_t{3} * width * height);
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x)
            for (const float value : shrunk(picture, image.size, x, y, step))
                out.push_back(static_cast<std::uint8_t>(png_value(value, picture.encoding, factor) * 255 + 0.5f));
    return out;
}

}  // namespace

std::vector<std::string> picture_names(const LookImage& image) {
    std::vector<std::string> names;
    for (const char* name : {"lit", "before", "normal", "base_normal", "roughness", "marked", "condition"})
        if (picture_of(image, name)) names.emplace_back(name);
    return names;
}

std::optional<std::string> png_of(const LookImage& image, const std::string& name) {
    const std::optional<Picture> picture = picture_of(image, name);
    if (!picture) return {};
    const MemoryFile file;
    io::DescriptorProxy proxy(file.descriptor());
    ImageOptions options;
    options.png = picture->encoding;
    options.exposure = image.exposure;
    io::PngRows rows(proxy, image.size, 3, options);
    if (!rows.write({picture->planes, image.size.width, image.size.height}) || !rows.finish())
        throw Error("there is no memory for a picture");
    return file.bytes(proxy.size());
}

std::string webp_of(const LookImage& image, const std::string& name, std::uint32_t longest) {
    const std::optional<Picture> picture = picture_of(image, name);
    if (!picture) throw Error(fmt::format("there is no picture \"{}\"", name));
    const std::uint32_t step = (std::max(image.size.width, image.size.height) + longest - 1) / longest;
    const std::vector<std::uint8_t> rgb = bytes_of(*picture, image, step);
    const int width = static_cast<int>((image.size.width + step - 1) / step);
    const int height = static_cast<int>((image.size.height + step - 1) / step);
    constexpr float quality = 90;
    std::uint8_t* memory = nullptr;
    const std::size_t size = name == "marked" ? WebPEncodeLosslessRGB(rgb.data(), width, height, 3 * width, &memory)
                                              : WebPEncodeRGB(rgb.data(), width, height, 3 * width, quality, &memory);
    const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> held(memory, &WebPFree);
    if (size == 0) throw Error(fmt::format("the picture \"{}\" cannot be packed as WebP", name));
    return {reinterpret_cast<const char*>(memory), size};
}

}  // namespace wrinkle
