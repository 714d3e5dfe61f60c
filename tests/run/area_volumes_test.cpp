// Volumes whose voxels are finer than pixels, by brute force over the area of each pixel.
#include <random>

#include "tests/run/area_truth.h"
#include "tests/run/temp_volume.h"

namespace wrinkle::test {
namespace {

/// Voxels of .25 m around the ground: noise of several octaves, the finest at the voxels themselves.
DenseVolume rough_ground() {
    DenseVolume volume;
    volume.first = {-96, -64, -8}, volume.size = {192, 192, 16};
    volume.background = 2.25f;  // their mean
    volume.world_from_index = {{{0.25, 0, 0, 0.1}, {0, 0.25, 0, 0}, {0, 0, 0.25, 0.05}, {0, 0, 0, 1}}};
    std::mt19937 random(3);
    std::vector<std::vector<float>> octaves;
    const auto [wide, high, deep] = volume.size;
    for (int k = 0; k < 4; ++k) {
        auto& octave = octaves.emplace_back(static_cast<std::size_t>(wide * high * deep) >> 3 * k);
        for (float& value : octave) value = static_cast<float>(random()) / 4294967296.0f * 0.3f * float(1 << k);
    }
    for (int z = 0; z < deep; ++z)
        for (int y = 0; y < high; ++y)
            for (int x = 0; x < wide; ++x) {
                float sum = 0;
                for (int k = 0; k < 4; ++k)
                    sum += octaves[std::size_t(k)]
                                  [std::size_t(((z >> k) * (high >> k) + (y >> k)) * (wide >> k) + (x >> k))];
                volume.values.push_back(sum);
            }
    return volume;
}

struct VolumeCase {
    VolumeFilter filter;
    double median, share;  ///< bounds: degrees; of the error without levels
};

/// Levels are means over cubes, across the surface as well as along it: white noise is averaged more than a pixel does,
/// and what a B-spline leaves of it less so. Bounds are about 1.4 times what was measured.
TEST(AreaVolumes, AreTheMeanOverThePixel) {
    const TempVolume file(rough_ground());
    const HostFrame frame = ground(kSize);
    for (const auto& [filter, median, share] :
         {VolumeCase{VolumeFilter::linear, 4.4, 0.26}, VolumeCase{VolumeFilter::smooth, 1.4, 0.18}}) {
        const Layer layer = layer_of(VolumeLayer{.file = file.file, .filter = filter}, 0.5);
        const std::vector<Area> areas = brute_force(scene_of(layer));
        Layer unfiltered = layer;
        unfiltered.footprint = false;
        const Pixels got = evaluate_area(frame, scene_of(layer));
        const Spread many = errors(got, areas), none = errors(evaluate_area(frame, scene_of(unfiltered)), areas);
        print("volume: 16 taps", many, "degrees"), print("without levels", none, "degrees");
        EXPECT_EQ(many.non_finite, 0u);
        EXPECT_LE(many.median, median);
        EXPECT_LE(many.median, share * none.median);
        EXPECT_LE(many.p99, none.p99 / 2);
        std::vector<Area> found = areas;
        for (std::size_t i = 0; i < areas.size(); ++i)
            found[i].xx = got.at("slope_covariance.xx")[i], found[i].yy = got.at("slope_covariance.yy")[i];
        fmt::print("sigma {:.3f}, true {:.3f}\n", sigma(found), sigma(areas));
        EXPECT_NEAR(sigma(found) / sigma(areas), 1, 0.05);
    }
}

}  // namespace
}  // namespace wrinkle::test
