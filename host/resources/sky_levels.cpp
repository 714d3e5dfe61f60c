#include "resources/sky_levels.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <numbers>

#include "base/vec.h"
#include "io/sky_picture.h"
#include "resources/ggx_lobes.h"
#include "resources/octahedral_map.h"

#include "layout.h"

namespace wrinkle {

namespace {

constexpr int kSourceSize = WR_SKY_SIZE;  // texels along the square that lobes are sampled from
static_assert(WR_SKY_SIZE >> (WR_SKY_LEVELS - 1) >= 2);

double alpha_of(int level) { return WR_SKY_ALPHA * std::pow(WR_SKY_ALPHA_RATIO, level); }

/// Sums up directions of a latlong picture in the texels that they belong to.
class Splats {
public:
    Splats() : means_(kSourceSize), sums_(means_.all.size()), weights_(means_.all.size()) {}

    /// A row of a picture: its pixels are cut into so many parts that every texel gets some.
    void add_row(const io::SkyRow& row) {
        const int parts = std::max(1, (4 * kSourceSize + row.height - 1) / row.height);
        const int across = std::max(1, (8 * kSourceSize + row.width - 1) / row.width);
        for (int i = 0; i < parts; ++i) {
            const double polar = std::numbers::pi * (row.y + (i + 0.5) / parts) / row.height;
            const double z = std::cos(polar), out = std::sin(polar);
            for (int x = 0; x < row.width; ++x)
                for (int j = 0; j < across; ++j) {
                    const double turn = std::numbers::pi * (1 - 2 * (x + (j + 0.5) / across) / row.width);
                    add({out * std::cos(turn), out * std::sin(turn), z},
                        row.rgb.data() + 3 * static_cast<std::size_t>(x), out);
                }
        }
    }

    OctahedralMap means() && {
        for (std::size_t i = 0; i < weights_.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                means_.all[i][c] = static_cast<float>(std::min(sums_[i][c] / weights_[i], double{FLT_MAX}));
        return std::move(means_);
    }

private:
    void add(const Vec3& direction, const float* rgb, double weight) {
        const auto [s, t] = OctahedralMap::place(direction);
        const auto index = [](double at) {
            return std::min(static_cast<std::size_t>(at * kSourceSize), std::size_t{kSourceSize - 1});
        };
        const std::size_t i = index(t) * kSourceSize + index(s);
        for (std::size_t c = 0; c < 3; ++c) sums_[i][c] += weight * double{rgb[c]};
        weights_[i] += weight;
    }

    OctahedralMap means_;
    std::vector<std::array<double, 3>> sums_;  // of finite pixels, whose sum may be too large for a float
    std::vector<double> weights_;
};

/// Level `level` of the picture whose mips are `source`: each sample of the lobe takes the mean over what it stands
/// for.
OctahedralMap filtered(const std::vector<OctahedralMap>& source, int level) {
    OctahedralMap out(WR_SKY_SIZE >> level);
    const std::vector<LobeSample> lobe = lobe_along_normal(alpha_of(level), std::size_t{32} << level);
    std::vector<std::size_t> mips;
    for (const LobeSample& sample : lobe) {
        const double texels = sample.solid_angle / (4 * std::numbers::pi) * kSourceSize * kSourceSize;
        const double mip = std::floor(std::log2(std::max(texels, 1.0)) / 2);
        mips.push_back(std::min(static_cast<std::size_t>(mip), source.size() - 1));
    }
    for (int y = 0; y < out.size; ++y)
        for (int x = 0; x < out.size; ++x) {
            const Vec3 n = OctahedralMap::direction((x + 0.5) / out.size, (y + 0.5) / out.size);
            const Vec3 right = normalize(cross(n, std::abs(n[0]) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})),
                       up = cross(n, right);
            std::array<double, 3> sum{};
            for (std::size_t k = 0; k < lobe.size(); ++k) {
                const Vec3& d = lobe[k].direction;
                Vec3 turned;
                for (std::size_t i = 0; i < 3; ++i) turned[i] = right[i] * d[0] + up[i] * d[1] + n[i] * d[2];
                const OctahedralMap::Texel seen = source[mips[k]].sample(turned);
                for (std::size_t c = 0; c < 3; ++c) sum[c] += lobe[k].weight * double{seen[c]};
            }
            for (std::size_t c = 0; c < 3; ++c)
                out.all[static_cast<std::size_t>(y * out.size + x)][c] = static_cast<float>(sum[c]);
        }
    return out;
}

/// Level `level` of what a sky of two colours shows of its zenith, horizon and ground. It depends on the elevation
/// only.
OctahedralMap filtered_colours(int level) {
    constexpr int steps = 512;
    const std::vector<LobeSample> lobe = lobe_along_normal(alpha_of(level), 2048);
    std::vector<OctahedralMap::Texel> by_angle(steps + 1);
    for (int i = 0; i <= steps; ++i) {
        const double angle = std::numbers::pi * i / steps, sine = std::sin(angle), cosine = std::cos(angle);
        std::array<double, 3> sum{};
        for (const LobeSample& sample : lobe) {
            const double z = sample.direction[2] * cosine - sample.direction[0] * sine;
            sum[0] += sample.weight * std::max(z, 0.0);
            if (z < 0) sum[2] += sample.weight;
        }
        sum[1] = 1 - sum[0] - sum[2];
        for (std::size_t c = 0; c < 3; ++c) by_angle[static_cast<std::size_t>(i)][c] = static_cast<float>(sum[c]);
    }
    OctahedralMap out(WR_SKY_SIZE >> level);
    for (int y = 0; y < out.size; ++y)
        for (int x = 0; x < out.size; ++x) {
            const double z = OctahedralMap::direction((x + 0.5) / out.size, (y + 0.5) / out.size)[2];
            const double at = std::acos(std::clamp(z, -1.0, 1.0)) / std::numbers::pi * steps;
            const auto i = std::min(static_cast<std::size_t>(at), std::size_t{steps - 1});
            const auto share = static_cast<float>(at - static_cast<double>(i));
            for (std::size_t c = 0; c < 3; ++c)
                out.all[static_cast<std::size_t>(y * out.size + x)][c] =
                    by_angle[i][c] * (1 - share) + by_angle[i + 1][c] * share;
        }
    return out;
}

std::vector<OctahedralMap> mips_of(const std::filesystem::path& file) {
    Splats splats;
    io::read_sky(file, [&](const io::SkyRow& row) { splats.add_row(row); });
    std::vector<OctahedralMap> mips{std::move(splats).means()};
    while (mips.back().size > 2) mips.push_back(mips.back().half());
    return mips;
}

/// A row of the table for a texture whose levels follow one after another from here on.
std::size_t begin_texture(TextureHeap& heap, int width, int height, int levels) {
    const std::size_t words = heap.table.size();
    heap.table.resize(words + WR_TEXTURE_WORDS);
    heap.table[words + WR_TEXTURE_WIDTH] = static_cast<std::uint32_t>(width);
    heap.table[words + WR_TEXTURE_HEIGHT] = static_cast<std::uint32_t>(height);
    heap.table[words + WR_TEXTURE_LEVELS] = static_cast<std::uint32_t>(levels);
    return words + WR_TEXTURE_OFFSETS;
}

}  // namespace

void add_sky_levels(TextureHeap& heap, const std::filesystem::path& file) {
    const std::vector<OctahedralMap> source = file.empty() ? std::vector<OctahedralMap>{} : mips_of(file);
    const std::size_t offsets = begin_texture(heap, WR_SKY_SIZE, WR_SKY_SIZE, WR_SKY_LEVELS);
    for (int level = 0; level < WR_SKY_LEVELS; ++level) {
        const OctahedralMap map = file.empty() ? filtered_colours(level) : filtered(source, level);
        heap.table[offsets + static_cast<std::size_t>(level)] = static_cast<std::uint32_t>(heap.texels.size());
        for (int y = -1; y <= map.size; ++y)
            for (int x = -1; x <= map.size; ++x) {
                const OctahedralMap::Texel& texel = map.at(x, y);
                heap.texels.insert(heap.texels.end(), {texel[0], texel[1], texel[2], 0});
            }
    }
}

void add_lobes(TextureHeap& heap) {
    constexpr int width = 2 * WR_LOBE_SIZE, height = WR_LOBE_SIZE;
    const std::vector<float>& lobes = ggx_lobes();
    const std::size_t offsets = begin_texture(heap, width, height, 1);
    heap.table[offsets] = static_cast<std::uint32_t>(heap.texels.size());
    for (int y = -1; y <= height; ++y)
        for (int x = -1; x <= width; ++x) {
            const int column = std::clamp(x, 0, width - 1), row = std::clamp(y, 0, height - 1);
            const float* const texel =
                lobes.data() + 3 * (static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column));
            heap.texels.insert(heap.texels.end(), {texel[0], texel[1], texel[2], 0});
        }
}

}  // namespace wrinkle
