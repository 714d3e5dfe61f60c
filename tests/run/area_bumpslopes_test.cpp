// A file of maketx --bumpslopes that was made smaller holds means of slopes, and of their products: what it shows over
// a pixel's area is what the larger height map shows there.
#include "tests/io/files.h"
#include "tests/run/area_truth.h"

namespace wrinkle::test {
namespace {

constexpr int kShrink = 2;

/// Means of Sobel slopes per texel of the small map, and of their products, as maketx has them: t points down.
struct Means {
    int size = 0;
    std::vector<std::array<float, 6>> texels;

    explicit Means(const Image& height) : size(height.width / kShrink) {
        const auto h = [&](int x, int y) {
            return double{height.at((x + height.width) % height.width, (y + height.height) % height.height, 0)};
        };
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size; ++column) {
                double sum[6] = {};
                for (int k = 0; k < kShrink * kShrink; ++k) {
                    const int x = kShrink * column + k % kShrink, y = kShrink * row + k / kShrink;
                    double s = 0, t = 0;
                    for (int i = -1; i <= 1; ++i) {
                        const double weight = (2 - std::abs(i)) / 8.0 * kShrink;
                        s += weight * (h(x + 1, y + i) - h(x - 1, y + i));
                        t -= weight * (h(x + i, y + 1) - h(x + i, y - 1));
                    }
                    const double all[] = {h(x, y), s, t, s * s, t * t, s * t};
                    for (int c = 0; c < 6; ++c) sum[c] += all[c] / (kShrink * kShrink);
                }
                std::array<float, 6>& texel = texels.emplace_back();
                std::ranges::copy(sum, texel.begin());
            }
    }
};

Layer bumpslopes(const fs::path& file, const Means& means, std::vector<std::string> channels) {
    write_image(file, {{make_spec(means.size, means.size, std::move(channels)), [&](int c, int x, int y) {
                            return means.texels[static_cast<std::size_t>((means.size - 1 - y) * means.size + x)]
                                               [static_cast<std::size_t>(c)];
                        }}});
    return layer_of(DerivativeMapLayer{{.file = file, .content = Content::slope}, planar}, 0.3);
}

TEST(AreaBumpslopes, ShowWhatTheHeightMapShows) {
    const TempFolder folder;
    const Means means(load_bump({.file = cobbles}));
    const Scene height = scene_of(layer_of(HeightMapLayer{{.file = cobbles}, planar}, 0.3));
    const HostFrame frame = ground(kSize);
    const std::vector<std::string> six{"b0_h", "b1_dhds", "b2_dhdt", "b3_dhds2", "b4_dhdt2", "b5_dh2dsdt"};
    const Pixels want = evaluate_area(frame, height);
    const Pixels got = evaluate_area(frame, scene_of(bumpslopes(folder / "six.exr", means, six)));
    const Pixels slopes =
        evaluate_area(frame, scene_of(bumpslopes(folder / "three.exr", means, {six.begin(), six.begin() + 3})));
    std::vector<double> degrees, spreads, lost;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (frame.pixels.at("depth")[i] > 60) continue;
        degrees.push_back(angle_degrees(vec_at(got, "normal", i), vec_at(want, "normal", i)));
        const auto sigma = [&](const Pixels& p) {
            return std::sqrt(double{p.at("slope_covariance.xx")[i]} + double{p.at("slope_covariance.yy")[i]});
        };
        spreads.push_back(std::abs(sigma(got) / sigma(want) - 1)), lost.push_back(1 - sigma(slopes) / sigma(want));
    }
    const Spread normals(degrees), sigmas(spreads), without(lost);
    print("bumpslopes: normals", normals, "degrees"), print("their sigma", sigmas, "relative");
    print("sigma without products, less", without, "relative");
    EXPECT_GT(normals.count, 200u);
    EXPECT_LT(normals.max, 1e-3);
    EXPECT_LT(sigmas.max, 0.05);
    EXPECT_GT(without.p99, 0.1) << "slopes alone do not know what was averaged";
}

}  // namespace
}  // namespace wrinkle::test
