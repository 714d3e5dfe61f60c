#include "resources/lost_slopes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "resources/texel_wrap.h"

namespace wrinkle {

namespace {

constexpr int kSlopes = 2, kProducts = 3, kChannels = kSlopes + kProducts;
/// The slopes that each of the products is of.
constexpr int kOf[kProducts][2] = {{0, 0}, {0, 1}, {1, 1}};

// A sample at u texels from a texel's middle, u in [0, 1/2], takes 1 - u of it and u of its neighbour on that side.
// Over the texel, both sides, these are the means of the weights, and of the products of two of them.
constexpr double kOwn = 3.0 / 4, kNeighbour = 1.0 / 8;
constexpr double kOwnOwn = 7.0 / 12, kOwnNeighbour = 1.0 / 12, kNeighbourNeighbour = 1.0 / 24;

/// A row of a level, which continues by one texel to both sides.
class Row {
public:
    Row(const Image& level, int y, Wrap wrap) : values_(static_cast<std::size_t>((level.width + 2) * kChannels)) {
        y = wrapped(y, level.height, wrap);
        auto value = values_.begin();
        for (int x = -1; x <= level.width; ++x)
            for (int c = 0; c < kChannels; ++c) *value++ = level.at(wrapped(x, level.width, wrap), y, c);
    }
    double operator()(int x, int channel) const {
        return values_[static_cast<std::size_t>((x + 1) * kChannels + channel)];
    }

private:
    std::vector<double> values_;
};

/// The mean of the product of two samples along a row, one of channel i of row a, one of channel j of row b.
double mean_product(const Row& a, int i, const Row& b, int j, int x) {
    const double own = a(x, i), left = a(x - 1, i), right = a(x + 1, i);
    return own * (kOwnOwn * b(x, j) + kOwnNeighbour * (b(x - 1, j) + b(x + 1, j))) +
           left * (kOwnNeighbour * b(x, j) + kNeighbourNeighbour * b(x - 1, j)) +
           right * (kOwnNeighbour * b(x, j) + kNeighbourNeighbour * b(x + 1, j));
}

double mean_sample(const Row& row, int channel, int x) {
    return kOwn * row(x, channel) + kNeighbour * (row(x - 1, channel) + row(x + 1, channel));
}

}  // namespace

Image with_products(const Image& slopes) {
    Image out{slopes.width, slopes.height, kChannels, {}};
    out.texels.reserve(slopes.texels.size() / kSlopes * kChannels);
    for (std::size_t i = 0; i + kSlopes <= slopes.texels.size(); i += kSlopes) {
        const float s = slopes.texels[i], t = slopes.texels[i + 1];
        out.texels.insert(out.texels.end(), {s, t, s * s, s * t, t * t});
    }
    return out;
}

Image lost_slopes(const Image& level, Wrap wrap) {
    Image out{level.width, level.height, kProducts, {}};
    out.texels.reserve(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height * kProducts));
    Row below(level, -1, wrap), row(level, 0, wrap);
    for (int y = 0; y < level.height; ++y) {
        Row above(level, y + 1, wrap);
        for (int x = 0; x < level.width; ++x) {
            std::array<double, kProducts> lost{};
            for (int k = 0; k < kProducts; ++k) {
                const int i = kOf[k][0], j = kOf[k][1], product = kSlopes + k;
                const double all = kOwn * mean_sample(row, product, x) +
                                   kNeighbour * (mean_sample(below, product, x) + mean_sample(above, product, x));
                const auto both = [&](const Row& a, const Row& b) { return mean_product(a, i, b, j, x); };
                const double shown =
                    kOwnOwn * both(row, row) + kNeighbourNeighbour * (both(below, below) + both(above, above)) +
                    kOwnNeighbour * (both(row, below) + both(below, row) + both(row, above) + both(above, row));
                lost[static_cast<std::size_t>(k)] = all - shown;
            }
            lost[0] = std::max(lost[0], 0.0), lost[2] = std::max(lost[2], 0.0);
            const double most = std::sqrt(lost[0] * lost[2]);
            lost[1] = std::clamp(lost[1], -most, most);
            for (const double part : lost) out.texels.push_back(static_cast<float>(part));
        }
        below = std::move(row), row = std::move(above);
    }
    return out;
}

}  // namespace wrinkle
