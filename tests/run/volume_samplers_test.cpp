// Kernels sample a grid as OpenVDB's own samplers do.
#include <openvdb/Grid.h>
#include <openvdb/io/File.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tree/Tree.h>

#include <limits>
#include <random>

#include "io/volume_file.h"
#include "tests/run/run_frame.h"
#include "tests/run/temp_volume.h"
#include "wrinkle/functions.h"

namespace wrinkle::test {
namespace {

template <class T>
using TreeOf = typename openvdb::tree::Tree4<T, 5, 4, 3>::Type;

/// A box of random voxels from 1 to 2. It spans several blocks, and indices on both sides of zero.
DenseVolume random_box() {
    DenseVolume volume;
    volume.first = {-13, -3, -20}, volume.size = {40, 19, 30};
    volume.background = 1.25f;
    volume.world_from_index = {{{0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 0.5, 0}, {0, 0, 0, 1}}};
    std::mt19937 random(5);
    for (int i = 0; i < 40 * 19 * 30; ++i) volume.values.push_back(1 + static_cast<float>(random()) / 4294967296.0f);
    return volume;
}

/// Within a cell the trilinear value is linear along each axis: its derivative there is the difference of two faces.
V box_gradient(const TreeOf<double>& tree, V p) {
    const auto at = [&](double x, double y, double z) {
        return openvdb::tools::BoxSampler::sample(tree, openvdb::Vec3d(x, y, z));
    };
    const V low{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
    return {at(low.x + 1, p.y, p.z) - at(low.x, p.y, p.z), at(p.x, low.y + 1, p.z) - at(p.x, low.y, p.z),
            at(p.x, p.y, low.z + 1) - at(p.x, p.y, low.z)};
}

TEST(VolumeSamplers, TrilinearValueAndGradientAreThoseOfOpenVDB) {
    const TempVolume file(random_box());
    openvdb::io::File in(file.file.string());
    in.open(false);
    const auto grid = openvdb::gridPtrCast<openvdb::Grid<TreeOf<float>>>(in.readGrid("density"));
    const TreeOf<double> tree(grid->tree());
    constexpr std::size_t count = 20'000;
    std::mt19937 random(6);
    std::map<std::string, std::vector<float>> columns;
    const double low[] = {-16, -6, -23}, high[] = {30, 19, 13};
    for (const char axis : {'x', 'y', 'z'})
        for (std::size_t i = 0; i < count; ++i) {
            const auto k = static_cast<std::size_t>(axis - 'x');
            columns[std::string("p.") + axis].push_back(
                static_cast<float>(low[k] + (high[k] - low[k]) * random() / 4294967296.0));
        }
    std::map<std::string, std::vector<float>> got;
    ColumnResults results;
    for (const char* name : {"value", "gradient.x", "gradient.y", "gradient.z"})
        results[name] = got[name] = std::vector<float>(count);
    evaluate_function(device(), function("volume_trilinear"), {columns.begin(), columns.end()}, results,
                      {.settings = {{"volume", file.file}}});
    std::vector<double> values, gradients;
    for (std::size_t i = 0; i < count; ++i) {
        const V p{columns["p.x"][i], columns["p.y"][i], columns["p.z"][i]};
        const double want = openvdb::tools::BoxSampler::sample(tree, openvdb::Vec3d(p.x, p.y, p.z));
        values.push_back(std::abs(got["value"][i] - want) / want);
        const V gradient = box_gradient(tree, p), found = vec_at(got, "gradient", i);
        if (length(gradient) > 0)
            gradients.push_back(length(found - gradient) / length(gradient));
        else
            EXPECT_EQ(length(found), 0) << "in the background";
    }
    EXPECT_GT(gradients.size(), count / 2);
    expect_within("trilinear value, to OpenVDB's", Spread(values), {1e-7, 1e-6, 1e-5}, "relative");
    expect_within("trilinear gradient, to OpenVDB's", Spread(gradients), {3e-7, 2e-6, 1e-5}, "relative");
}

/// From 2^24 on not every index is a float: voxels of 1 mm are that far out at 17 km. What lies beside the box is its
/// background, on both sides of it, and nothing is read outside of the buffer (seen by sanitizers, and by a crash).
TEST(VolumeSamplers, ReadGridsFarFromTheOrigin) {
    for (const int far : {1 << 24, 1 << 28, -(1 << 28), (1 << 29) + 24, 64 - (1 << 30)}) {
        DenseVolume volume = random_box();
        volume.first = {far, far, far}, volume.background = 3;
        const TempVolume file(volume);
        const Volume grid = load_volume(file.file, "");
        std::map<std::string, std::vector<float>> columns;
        const int step = std::max(2, std::abs(far) >> 23);             // apart in float
        const int stored = static_cast<int>(static_cast<float>(far));  // what a float makes of it
        for (int i = -40; i < 80; ++i)
            for (const char axis : {'x', 'y', 'z'})
                columns[std::string("p.") + axis].push_back(static_cast<float>(far + (axis == 'x' ? i * step : 0)));
        for (const float beyond :
             {-1e30F, 1e30F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 0.0F})
            for (const char axis : {'x', 'y', 'z'}) columns[std::string("p.") + axis].push_back(beyond);
        const std::size_t count = columns["p.x"].size();
        for (const std::string name : {"volume_trilinear", "volume_bspline"}) {
            std::map<std::string, std::vector<float>> got;
            ColumnResults results;
            for (const char* result : {"value", "gradient.x", "gradient.y", "gradient.z"})
                results[result] = got[result] = std::vector<float>(count);
            evaluate_function(device(), function(name), {columns.begin(), columns.end()}, results,
                              {.settings = {{"volume", file.file}}});
            for (std::size_t i = 0; i < count; ++i) {
                const float x = columns["p.x"][i];
                if (!(std::abs(x) < 2e9F) || x == 0 || std::abs(x - static_cast<float>(far)) > 60) {
                    EXPECT_EQ(got["value"][i], 3.0F) << name << " at " << x;
                } else if (name == "volume_trilinear") {
                    EXPECT_EQ(got["value"][i], grid.at(static_cast<int>(x), stored, stored, 0))
                        << x - static_cast<float>(far);
                }
            }
        }
    }
}

}  // namespace
}  // namespace wrinkle::test
