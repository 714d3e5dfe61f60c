#include "resources/texture_heap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/limits.h"
#include "io/texture_doubts.h"
#include "io/volume_file.h"
#include "resources/lost_slopes.h"
#include "resources/sky_levels.h"
#include "resources/texel_wrap.h"
#include "resources/volume_heap.h"
#include "wrinkle/error.h"

#include "layout.h"

namespace wrinkle {

namespace {

/// The next coarser level, half as many texels each way: every texel is the mean over the area that it covers. Where
/// the finer level has an odd number of them, a texel covers two and a part of a third.
Image half(const Image& fine) {
    struct Share {
        int texel;
        float weight;
    };
    const auto shares = [](int fine_size, int coarse_size) {
        std::vector<std::vector<Share>> all(static_cast<std::size_t>(coarse_size));
        for (int i = 0; i < coarse_size; ++i) {
            const double texels = static_cast<double>(fine_size) / coarse_size, from = i * texels, to = from + texels;
            for (int k = static_cast<int>(from); k < fine_size && k < to; ++k)
                if (const double covered = std::min(to, k + 1.0) - std::max(from, static_cast<double>(k));
                    covered > 1e-9)
                    all[static_cast<std::size_t>(i)].push_back({k, static_cast<float>(covered / texels)});
        }
        return all;
    };
    Image coarse{std::max(fine.width / 2, 1), std::max(fine.height / 2, 1), fine.channels, {}};
    coarse.texels.reserve(static_cast<std::size_t>(coarse.width) *
                          static_cast<std::size_t>(coarse.height * coarse.channels));
    const auto columns = shares(fine.width, coarse.width), rows = shares(fine.height, coarse.height);
    for (const std::vector<Share>& row : rows)
        for (const std::vector<Share>& column : columns)
            for (int c = 0; c < coarse.channels; ++c) {
                float mean = 0;
                for (const Share& y : row)
                    for (const Share& x : column) mean += y.weight * x.weight * fine.at(x.texel, y.texel, c);
                coarse.texels.push_back(mean);
            }
    return coarse;
}

/// The slopes of heights per unit of texture coordinate: the derivative matrix D against the smoothing matrix B of
/// [Mik20 eq. 20, 21], at texel centres. Beyond a clamped edge the heights go on as they are there.
Image slopes_of_heights(const Image& h, Wrap wrap) {
    Image slopes{h.width, h.height, 2, {}};
    slopes.texels.reserve(2 * h.texels.size());
    for (int y = 0; y < h.height; ++y) {
        const int down = wrapped(y - 1, h.height, wrap), up = wrapped(y + 1, h.height, wrap);
        for (int x = 0; x < h.width; ++x) {
            const int left = wrapped(x - 1, h.width, wrap), right = wrapped(x + 1, h.width, wrap);
            const double s = (h.at(right, down, 0) - h.at(left, down, 0)) +
                             2.0 * (h.at(right, y, 0) - h.at(left, y, 0)) + (h.at(right, up, 0) - h.at(left, up, 0));
            const double t = (h.at(left, up, 0) - h.at(left, down, 0)) + 2.0 * (h.at(x, up, 0) - h.at(x, down, 0)) +
                             (h.at(right, up, 0) - h.at(right, down, 0));
            slopes.texels.push_back(static_cast<float>(s / 8 * h.width));
            slopes.texels.push_back(static_cast<float>(t / 8 * h.height));
        }
    }
    return slopes;
}

bool is_whole(const PlannedTexture& planned) { return planned.region == std::array<double, 4>{0, 0, 1, 1}; }

/// The texels of a region, whole ones, at least one each way.
Image cropped(const Image& image, const std::array<double, 4>& region) {
    const auto range = [](double from, double to, int size) {
        const int first = std::clamp(static_cast<int>(std::lround(from * size)), 0, size - 1);
        return std::pair{first, std::clamp(static_cast<int>(std::lround(to * size)), first + 1, size)};
    };
    const auto [left, right] = range(region[0], region[2], image.width);
    const auto [bottom, top] = range(region[1], region[3], image.height);
    Image out{right - left, top - bottom, image.channels, {}};
    for (int y = bottom; y < top; ++y)
        for (int x = left; x < right; ++x)
            for (int c = 0; c < image.channels; ++c) out.texels.push_back(image.at(x, y, c));
    return out;
}

/// Slopes of tangent-space normals [Mik20 listing 2]; m = 0 is flat.
Image slopes_of_normals(const Image& image, bool y_down) {
    Image slopes{image.width, image.height, 2, {}};
    for (std::size_t i = 0; i + 3 <= image.texels.size(); i += 3) {
        const double x = 2.0 * image.texels[i] - 1, y = (y_down ? -1 : 1) * (2.0 * image.texels[i + 1] - 1);
        const double z = std::abs(2.0 * image.texels[i + 2] - 1);
        const double size = std::max(z, std::max(std::abs(x), std::abs(y)) / WR_MAX_SLOPE);
        slopes.texels.push_back(size > 0 ? static_cast<float>(-x / size) : 0.0f);
        slopes.texels.push_back(size > 0 ? static_cast<float>(-y / size) : 0.0f);
    }
    return slopes;
}

/// Slopes of a map whose green channel points down: those along t change their sign, and products of one of them.
Image turned_down(Image slopes) {
    const auto channels = static_cast<std::size_t>(slopes.channels);
    for (std::size_t i = 0; i < slopes.texels.size(); i += channels)
        for (std::size_t c = 1; c < channels; c += 2) slopes.texels[i + c] = -slopes.texels[i + c];
    return slopes;
}

/// Channels [first, end) of an image.
Image channels_of(const Image& image, int first, int end) {
    Image out{image.width, image.height, end - first, {}};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = first; c < end; ++c) out.texels.push_back(image.at(x, y, c));
    return out;
}

/// Appends a level with its border of one texel. Three channels take four floats, so that a texel is one load.
void append(TextureHeap& heap, const Image& level, Wrap wrap) {
    for (int y = -1; y <= level.height; ++y)
        for (int x = -1; x <= level.width; ++x) {
            for (int c = 0; c < level.channels; ++c)
                heap.texels.push_back(level.at(wrapped(x, level.width, wrap), wrapped(y, level.height, wrap), c));
            if (level.channels == 3) heap.texels.push_back(0);
        }
}

/// The finest level, of which the coarser ones are means.
Image finest_level(const Image& image, const PlannedTexture& planned) {
    const TextureUse& use = planned.use;
    const bool slopes = planned.kind == TexelKind::slope || planned.kind == TexelKind::lost_slopes;
    Image level = is_whole(planned) ? image : cropped(image, planned.region);
    if (use.content == Content::normal) level = slopes_of_normals(level, use.y_down);
    if (use.content == Content::slope && use.y_down) level = turned_down(std::move(level));
    if (slopes && use.content == Content::height) level = slopes_of_heights(level, use.wrap);
    const bool products = slopes && level.channels == 5;  // the file brings its own
    if (planned.kind == TexelKind::lost_slopes) return products ? level : with_products(level);
    return products ? channels_of(level, 0, 2) : level;
}

}  // namespace

void add_texture(TextureHeap& heap, const Image& image, const PlannedTexture& planned) {
    Image level = finest_level(image, planned);
    // All levels together take 4/3 of the finest. Borders, and the unused fourth float of three-channel texels, are
    // left out of this estimate.
    check_memory(planned.use.file.string(), sizeof(float) * 4.0 / 3 * static_cast<double>(level.texels.size()),
                 fmt::format("its mips from {} x {} texels on", level.width, level.height));
    const std::size_t words = heap.table.size();
    heap.table.resize(words + WR_TEXTURE_WORDS);
    heap.table[words + WR_TEXTURE_WIDTH] = static_cast<std::uint32_t>(level.width);
    heap.table[words + WR_TEXTURE_HEIGHT] = static_cast<std::uint32_t>(level.height);
    std::uint32_t count = 0;
    for (; count < WR_MAX_LEVELS; ++count) {
        heap.table[words + WR_TEXTURE_OFFSETS + count] = static_cast<std::uint32_t>(heap.texels.size());
        append(heap, planned.kind == TexelKind::lost_slopes ? lost_slopes(level, planned.use.wrap) : level,
               planned.use.wrap);
        if (level.width == 1 && level.height == 1) {
            ++count;
            break;
        }
        level = half(level);
    }
    heap.table[words + WR_TEXTURE_LEVELS] = count;
    if (heap.texels.size() > (std::size_t{1} << 31) - 1)
        throw Error(fmt::format("{}: the textures exceed 8 GiB together", planned.use.file.string()));
}

TextureHeap load_textures(const std::vector<PlannedTexture>& planned) {
    TextureHeap heap;
    std::vector<std::pair<TextureUse, Image>> atlases;  // files of which only regions are used
    const auto judged = [&](Image image, const PlannedTexture& texture) {
        std::string doubt = texture.kind == TexelKind::mask ? "" : io::texture_doubt(texture.use, image);
        if (!doubt.empty() && !texture.layer.empty()) doubt = fmt::format("{}: {}", texture.layer, doubt);
        if (!doubt.empty() && std::ranges::find(heap.doubts, doubt) == heap.doubts.end())
            heap.doubts.push_back(std::move(doubt));
        return image;
    };
    const auto load = [&](const PlannedTexture& texture) {
        if (texture.kind == TexelKind::sky) return add_sky_levels(heap, texture.use.file);
        if (texture.kind == TexelKind::lobes) return add_lobes(heap);
        if (texture.kind == TexelKind::volume || texture.kind == TexelKind::volume_smooth) {
            const Volume volume = load_volume(texture.use.file, texture.grid);
            if ((volume.info.channels == 3) != texture.vectors)  // the file is another one than when it was planned
                throw Error(fmt::format("{}: was replaced while it was read", texture.use.file.string()));
            add_planned_volume(heap, volume, texture, planned.size());
        } else if (is_whole(texture)) {
            add_texture(heap, judged(load_bump(texture.use), texture), texture);
        } else {
            TextureUse read = texture.use;  // wrapping and green's direction come after reading
            read.wrap = Wrap::repeat, read.y_down = false;
            auto atlas = std::ranges::find(atlases, read, &std::pair<TextureUse, Image>::first);
            if (atlas == atlases.end()) atlas = atlases.emplace(atlas, read, judged(load_bump(read), texture));
            add_texture(heap, atlas->second, texture);
        }
    };
    for (const PlannedTexture& texture : planned) {
        try {
            load(texture);
        } catch (const Error& error) {
            if (texture.layer.empty()) throw;
            throw Error(fmt::format("{}: {}", texture.layer, error.what()));
        }
    }
    heap.table.insert(heap.table.end(), heap.further.begin(), heap.further.end());
    heap.texels.resize(heap.texels.size() + kTexelsAfterTheLast);
    return heap;
}

void check_fits(const TextureHeap& heap, const DeviceInfo& device) {
    const std::size_t bytes = heap.texels.size() * sizeof(float);
    if (bytes <= device.largest_buffer) return;
    const auto megabytes = [](std::uint64_t size) { return static_cast<double>(size) / (1 << 20); };
    throw Error(fmt::format(
        "the textures and volumes take {:.1f} MiB together; {} allows {:.1f} MiB in one buffer: use smaller "
        "ones (crop or resample grids; footprint = false does without their coarser levels), or another device",
        megabytes(bytes), device.name, megabytes(device.largest_buffer)));
}

}  // namespace wrinkle
