// The condition of pixels is compared with what happens when inputs are really moved by one ulp.
#include "run/condition.h"

#include <bit>
#include <random>

#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

constexpr double kUnit = 0x1p-24;

/// The frame with every number of the planes that condition moves one ulp up or down, as a seed says.
HostFrame moved(HostFrame frame, unsigned seed) {
    std::mt19937 random(seed);
    for (auto& [name, plane] : frame.pixels) {
        if (name == "object" || name == "tangent_sign" || name.starts_with("crypto.") || name.starts_with("channel:"))
            continue;
        for (float& v : plane)
            if (v != 0 && std::isfinite(v))
                v = std::bit_cast<float>(std::bit_cast<std::uint32_t>(v) + (random() % 2 == 0 ? 1 : -1));
    }
    return frame;
}

std::vector<float> condition_of(const HostFrame& frame, const Scene& scene) {
    Condition condition(device(), scene, frame.frame);
    PlaneBuffers planes(device(), condition.inputs(), frame.count(), sizeof(float));
    for (const std::string& name : condition.inputs())
        std::ranges::copy(frame.pixels.at(name), planes.map<float>(name, CL_MAP_WRITE));
    planes.unmap();
    return condition.evaluate(planes, {.first = 0, .count = frame.frame.size.height});
}

/// The angles, in radians, by which the reference's normals turn when the inputs are moved.
std::vector<double> turned(const HostFrame& frame, const Scene& scene, unsigned seed) {
    const Truth before(frame, scene), after(moved(frame, seed), scene);
    std::vector<double> out(frame.count());
    for (std::size_t i = 0; i < frame.count(); ++i)
        if (before.pixels[i].valid && after.pixels[i].valid)
            out[i] = angle_degrees(before.pixels[i].normal, after.pixels[i].normal) / 57.29577951308232;
    return out;
}

class ConditionScenes : public testing::TestWithParam<const char*> {};

TEST_P(ConditionScenes, BoundsWhatInputsMovedByAnUlpDo) {
    constexpr unsigned seed = 11;
    const HostFrame frame = small_frame();
    Scene scene = data_scene(GetParam());
    scene.lighting = {};
    const std::vector<float> condition = condition_of(frame, scene);
    const std::vector<double> radians = turned(frame, scene, seed);
    std::vector<double> shares;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (condition[i] == 0) {
            EXPECT_LE(radians[i], 1e-12) << i << ", seed " << seed;
            continue;
        }
        shares.push_back(radians[i] / (condition[i] * kUnit));
    }
    const Spread spread(shares);
    print(std::string(GetParam()) + ": turn / condition", spread, "");
    EXPECT_GT(spread.count, frame.count() / 4);
    EXPECT_EQ(spread.non_finite, 0u);
    // Inputs that move in random directions partly cancel each other, so a normal turns by less than the condition,
    // which adds them all up. But neighbours, which texture coordinates are differenced with, move in other directions
    // here than when condition was computed, so a few pixels may turn by more.
    EXPECT_GT(spread.median, 0.1);
    EXPECT_LT(spread.median, 1);
    EXPECT_LT(spread.p99, 2) << "seed " << seed;
}
INSTANTIATE_TEST_SUITE_P(Scenes, ConditionScenes, testing::Values("constant", "decals", "noise", "normal_map"),
                         [](const auto& info) { return std::string(info.param); });

TEST(Condition, NeedsDoublePrecision) {
    Device without = device();
    without.info.fp64 = false;
    EXPECT_THROW(Condition(without, Scene{}, small_frame().frame), Error);
}

// Nothing is bumped here, so condition is only what an ulp in each of the normal's three components does.
TEST(Condition, IsOfANormalWhatItsRoundingIs) {
    const HostFrame frame = small_frame();
    const std::vector<float> condition = condition_of(frame, {});
    const Truth truth(frame, {});
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (!truth.pixels[i].valid) {
            EXPECT_EQ(condition[i], 0) << i;
            continue;
        }
        EXPECT_LE(condition[i], 2 * (1 + 1 + 1)) << i;  // an ulp is at most 2^-23 of a number: two units
    }
}

}  // namespace
}  // namespace wrinkle::test
