// Scenes whose surfaces mirror skies: compiled in where a sky asks for it, in the sky's own axes, and used by
// relighting as by lighting.
#include "layers/kinds.h"
#include "run/pass_impl.h"
#include "tests/io/files.h"
#include "tests/reference/relit.h"
#include "tests/reference/sky.h"
#include "tests/run/light_frames.h"

namespace wrinkle::test {
namespace {

HostFrame tilted_plane() {
    HostFrame frame(plane_frame(test_camera(), {19, 11}, normalize(V{0.1, -0.2, 1})), test_camera());
    for (const char* color : {"r", "g", "b"}) frame.add(std::string("beauty.") + color, 0.5f);
    return frame;
}

V shown(V d) { return V{1 + 0.6 * d.x, 1 - 0.5 * d.y, 1 + 0.4 * d.z}; }

/// Two skies: a picture, whose top is y and which is turned by 90 degrees, and one of two colours.
std::vector<Light> skies(const TempFolder& folder) {
    constexpr int height = 32;
    write_exr(folder / "sky.exr", 2 * height, height, {"R", "G", "B"}, [](int channel, int x, int y) {
        const double up = M_PI * (0.5 - (y + 0.5) / height), turn = M_PI * (1 - (x + 0.5) / height);
        const V seen = shown({std::cos(up) * std::cos(turn), std::cos(up) * std::sin(turn), std::sin(up)});
        return static_cast<float>(channel == 0 ? seen.x : channel == 1 ? seen.y : seen.z);
    });
    Light picture{.kind = LightKind::sky, .intensity = 2, .up = {0, 1, 0}, .texture = folder / "sky.exr"};
    picture.rotation = M_PI / 2, picture.harmonics = load_sky(picture.texture), picture.highlights = true;
    Light colours{.kind = LightKind::sky, .up = {0.6, 0, 0.8}, .highlights = true};
    colours.zenith = {0.2, 0.3, 0.5}, colours.horizon = {0.4, 0.4, 0.4}, colours.ground = {0.1, 0.05, 0};
    return {picture, Light{.intensity = 0.5, .direction = {-0.6, 0, -0.8}}, colours};
}

std::vector<Light> without_highlights(std::vector<Light> lights) {
    for (Light& light : lights) light.highlights = false;
    return lights;
}

TEST(MirroredSkies, AreSeenInTheirOwnAxes) {
    const HostFrame frame = tilted_plane();
    const TempFolder folder;
    const std::vector<Light> lights = skies(folder);
    const Scene scene = scene_lit_by(lights), dull = scene_lit_by(without_highlights(lights));
    const Pixels bright = evaluate_on(frame, scene), flat = evaluate_on(frame, dull);
    const Truth truth(frame, dull);
    // Turned by 90 degrees around y, which is the picture's top, from x in its middle: the middle is at -z.
    const auto radiance = [&](V d) { return shown({-d.z, -d.x, d.y}) * 2.0 + reference::sky_radiance(lights[2], d); };
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.pixels.size(); i += 13) {
        const auto& at = truth.pixels[i];
        if (!at.valid) continue;
        const V want =
            reference::mirrored_sky<double>(radiance, at.normal, at.base_normal, at.view, {{}, 0.5, 0.04}, 100);
        errors.push_back(length(vec_at(bright, "lit", i) - vec_at(flat, "lit", i) - want) / length(want));
    }
    expect_within("mirrored", Spread(std::move(errors)), {0.05, 0.15, 0.2}, "relative");
}

TEST(MirroredSkies, AreCompiledInWhereThereAreSome) {
    const HostFrame frame = tilted_plane();
    const TempFolder folder;
    const std::vector<Light> lights = skies(folder), dull = without_highlights(lights);
    std::vector<Light> none{lights[1]};
    Pass before = evaluate(device(), scene_lit_by(none), frame.frame),
         after = evaluate(device(), scene_lit_by(dull), frame.frame);
    EXPECT_EQ(before.impl().plan.source, after.impl().plan.source);
    EXPECT_TRUE(after.impl().plan.textures.empty());
    EXPECT_THROW(after.set_parameters(scene_lit_by(lights)), Error) << "whether a sky is mirrored is compiled in";
}

TEST(MirroredSkies, RelightAsTheyLight) {
    const HostFrame frame = tilted_plane();
    const TempFolder folder;
    Scene scene = scene_lit_by(skies(folder)), flat = scene;
    flat.layers.clear();
    const Pixels now = evaluate_on(frame, scene), old = evaluate_on(frame, flat);
    scene.lighting.relight = Relight::ratio;
    const Pixels ratio = evaluate_on(frame, scene);
    for (const char* plane : {"lit.r", "lit.g", "lit.b"})
        for (std::size_t i = 0; i < now.at(plane).size(); ++i) {
            const double want = 0.5 * reference::relight_ratio(double(now.at(plane)[i]), double(old.at(plane)[i]), 4.0);
            EXPECT_NEAR(ratio.at(plane)[i], want, 2e-4) << plane << " " << i;
        }
}

}  // namespace
}  // namespace wrinkle::test
