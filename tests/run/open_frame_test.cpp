#include "run/open_frame.h"

#include "tests/io/files.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

std::string refusal(const Scene& scene) {
    try {
        describe_frame(scene);
    } catch (const Error& error) { return error.what(); }
    return "nothing was refused";
}

TEST(OpenFrame, SlopesComeFromNoPixelsThatAreRepeated) {
    const TempFolder folder;
    const auto value = [](int c, int, int) { return c == 2 || c == 3 ? 1.0f : 0.0f; };
    write_exr(folder / "data.exr", 8, 6, {"N.X", "N.Y", "N.Z", "Z", "dust"}, value);
    const std::vector<std::string> colors{
        "R", "G", "B", "dirt", "dust", "volume_gradient.X", "volume_gradient.Y", "volume_gradient.Z"};
    write_exr(folder / "small.exr", 4, 3, colors, value);
    write_exr(folder / "equal.exr", 8, 6, colors, value);
    Scene scene;
    scene.gbuffer.file = folder / "data.exr";
    scene.gbuffer.roles["depth"] = "Z";
    scene.camera.inline_camera = test_camera();
    scene.layers.resize(1);
    scene.layers[0].name = "wear";
    const auto expect = [&](const char* picture, const std::string& channel) {
        scene.gbuffer.beauty_file = folder / picture;
        const std::string text = refusal(scene);
        std::vector<std::string> parts{"nothing was refused"};
        if (!channel.empty())
            parts = {"wear", "\"" + channel + "\"", "small.exr", "data.exr", "render it at the frame's size"};
        for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
    };
    scene.layers[0].bump = HeightChannelLayer{"dirt"};
    expect("small.exr", "dirt");
    expect("equal.exr", "");
    scene.layers[0].bump = HeightChannelLayer{"dust"};  // the frame's own
    expect("small.exr", "");
    scene.layers[0].bump = GradientLayer{};
    expect("small.exr", "volume_gradient.X");
    expect("equal.exr", "");
    scene.layers[0].bump = ConstantLayer{{0.1, 0, 0}};
    scene.layers[0].mask.channel = "dirt";  // a mask may be coarse
    expect("small.exr", "");
}

}  // namespace
}  // namespace wrinkle::test
