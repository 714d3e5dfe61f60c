#include <fmt/format.h>

#include <algorithm>

#include "base/only_errors.h"
#include "io/texture_texels.h"
#include "io/volume_file.h"
#include "resources/volume_heap.h"
#include "wrinkle/error.h"
#include "wrinkle/resources.h"

namespace wrinkle {

namespace {

/// The texels of an image in memory as a source, bottom row first.
TexelSource source_of(const ImageInMemory& image) {
    if (image.width == 0 || image.height == 0 || image.channels == 0)
        throw Error(fmt::format("the image has {} x {} pixels of {} channels; expected one of each at least",
                                image.width, image.height, image.channels));
    const std::size_t wanted = std::size_t{image.width} * image.height * image.channels;
    if (image.texels.size() != wanted)
        throw Error(fmt::format("the image has {} numbers; {} x {} pixels of {} channels are {}", image.texels.size(),
                                image.width, image.height, image.channels, wanted));
    const int width = static_cast<int>(image.width), height = static_cast<int>(image.height);
    const auto read = [image, width, height](int channels) {
        Image out{width, height, channels, {}};
        const std::size_t row = std::size_t{image.width} * image.channels;
        for (std::size_t y = image.height; y-- > 0;)
            for (std::size_t at = y * row; at < (y + 1) * row; at += image.channels) {
                const auto texel = image.texels.subspan(at, static_cast<std::size_t>(channels));
                out.texels.insert(out.texels.end(), texel.begin(), texel.end());
            }
        return out;
    };
    return {OIIO::ImageSpec(width, height, static_cast<int>(image.channels), OIIO::TypeFloat), "memory", read};
}

TexelKind kind_of(const ImageSource& image) {
    const Content content = image.use.content;
    const auto expect = [](bool fits, const char* store, const char* contents) {
        if (!fits) throw Error(fmt::format("only {} can be stored as {}", contents, store));
    };
    switch (image.store) {
        case TexelStore::slopes:
            expect(content != Content::object_normal, "slopes", "heights, tangent-space normals and slopes");
            return TexelKind::slope;
        case TexelStore::values:
            expect(content == Content::height, "values", "heights and masks (content = height)");
            return TexelKind::height;
        case TexelStore::vectors:
            expect(content == Content::object_normal, "vectors", "object-space normals");
            return TexelKind::vector;
    }
    throw Error("the way to store it is none of slopes, values and vectors");
}

void check_region(const std::array<double, 4>& r) {
    if (!(r[0] >= 0 && r[0] < r[2] && r[2] <= 1 && r[1] >= 0 && r[1] < r[3] && r[3] <= 1))
        throw Error(
            fmt::format("the region [{}, {}, {}, {}] is none; expected s and t from, then s and t to, within 0 "
                        "and 1",
                        r[0], r[1], r[2], r[3]));
}

/// Appends a source; returns its index_from_world.
Mat4 add(TextureHeap& heap, const ImageSource& source) {
    PlannedTexture planned{.use = source.use, .kind = kind_of(source), .region = source.region};
    check_region(source.region);
    if (source.memory) planned.use.file = "memory";
    add_texture(heap, source.memory ? bump_of(source_of(*source.memory), source.use) : load_bump(source.use), planned);
    return {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
}

Mat4 add(TextureHeap& heap, const VolumeSource& source) {
    const Volume volume = load_volume(source.file, source.grid);
    const bool smooth = source.filter == VolumeFilter::smooth;
    if (smooth && volume.info.channels != 1)
        throw Error(fmt::format("{}: the grid \"{}\" holds vectors, which are sampled linearly only",
                                source.file.string(), volume.info.grid));
    add_volume(heap, volume, smooth ? TexelKind::volume_smooth : TexelKind::volume);
    return volume.info.index_from_world;
}

}  // namespace

TexelData texel_data(std::span<const TextureSource> sources) {
    return only_errors("texel data", [&] {
        TextureHeap heap;
        std::vector<Mat4> index_from_world;
        for (const TextureSource& source : sources) {
            try {
                index_from_world.push_back(std::visit([&](const auto& each) { return add(heap, each); }, source));
            } catch (const Error& error) {
                throw Error(fmt::format("texture source {}: {}", index_from_world.size(), error.what()));
            }
        }
        heap.texels.resize(heap.texels.size() + kTexelsAfterTheLast);
        return TexelData{std::move(heap.texels), std::move(heap.table), std::move(index_from_world)};
    });
}

}  // namespace wrinkle
