// A picture that is relit by ratio beside the picture rendered again with the same bumps: never worse than unbumped.
#include <cmath>

#include "tests/run/run_frame.h"
#include "tools/frame_lights.h"
#include "tools/metal_pictures.h"

namespace wrinkle::test {
namespace {

double srgb(double linear) {
    const double c = std::clamp(linear, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
}

/// Decibels by which a picture is off the one rendered with bumps, on pixels of one object; 0: on all.
double decibels(const HostFrame& frame, const Pixels& planes, const std::string& layer, const char* colours,
                int object) {
    const std::vector<float>& objects = frame.pixels.at("object");
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
        if (object != 0 && objects[i] != static_cast<float>(object)) continue;
        for (int c = 0; c < 3; ++c) {
            const float wanted = frame.pixels.at(std::string("channel:Bumped.") + "RGB"[c])[i];
            const double gap = srgb(planes.at(layer + colours[c])[i]) - srgb(wanted);
            sum += gap * gap, ++count;
        }
    }
    return -10 * std::log10(sum / count);
}

/// The lights of bench/picture/NAME.toml, without what a user may not know of them.
Lighting lights(const Scene& scene, bool sky, bool pictures) {
    Lighting lighting = scene.lighting;
    if (!sky) std::erase_if(lighting.lights, [](const Light& light) { return light.kind == LightKind::sky; });
    if (!pictures)
        for (Light& light : lighting.lights) light.picture.clear();
    return lighting;
}

struct Way {
    const char* name;
    Lighting (*lighting)(const Scene& scene);
};

const Way kWays[] = {{"lights and sky", [](const Scene& scene) { return lights(scene, true, false); }},
                     {"shadows read",
                      [](const Scene& scene) {
                          Lighting read = lights(scene, true, false);
                          read.shadows = Shadows::read;
                          return read;
                      }},
                     {"pictures, no sky", [](const Scene& scene) { return lights(scene, false, true); }},
                     {"pictures", [](const Scene& scene) { return lights(scene, true, true); }},
                     {"fitted",
                      [](const Scene& scene) {
                          Scene bare = scene;
                          bare.lighting.lights.clear();
                          EXPECT_TRUE(wants_lights(bare));
                          return with_lights(bare, find_lights(bare, 0)).lighting;
                      }},
                     {"named, in another unit", [](const Scene& scene) {
                          Scene other = scene;
                          other.lighting = lights(scene, false, false);
                          for (Light& light : other.lighting.lights) light.intensity *= 7;
                          EXPECT_TRUE(wants_lights(other));
                          return with_lights(other, find_lights(other, 0)).lighting;
                      }}};

struct Picture {
    const char* name;
    int objects;
    double gain;   ///< decibels of the whole frame
    int metal;     ///< which object is
    double shine;  ///< decibels that it gains
};

class Rerender : public testing::TestWithParam<Picture> {};

TEST_P(Rerender, IsCloserThanTheUnbumpedPicture) {
    const HostFrame frame = data_frame(GetParam().name);
    Scene scene = load_scene(data_folder / "../bench/picture" / (GetParam().name + std::string(".toml")));
    ASSERT_TRUE(wants_metals(scene));
    const MetalPictures metals = metals_of_frame(scene, 0);
    ASSERT_TRUE(metals);
    ASSERT_EQ(metals->size(), 1u);
    EXPECT_EQ(metals->front().object, GetParam().metal);
    for (const Way& way : kWays) {
        Scene own = scene;
        own.lighting = way.lighting(scene), own.lighting.metals = metals;
        const Pixels got = evaluate_on(frame, own);
        for (int object = 0; object <= GetParam().objects; ++object) {
            const double before = decibels(frame, frame.pixels, "beauty.", "rgb", object);
            const double after = decibels(frame, got, "lit.", "rgb", object);
            fmt::print("{}, object {}: {:.1f} dB, unbumped {:.1f}\n", way.name, object, after, before);
            const double gain = object == 0 ? GetParam().gain : object == GetParam().metal ? GetParam().shine : -0.1;
            EXPECT_GT(after, before + gain) << way.name << ", object " << object;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Frames, Rerender, testing::Values(Picture{"relit", 3, 4, 2, 5}, Picture{"yard", 5, 3, 4, 0.2}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace wrinkle::test
