// Every figure of data/figures can be drawn, from the small frame; mistakes in figure files are told.
#include "tools/draw_figure.h"

#include <OpenImageIO/imageio.h>

#include "tests/io/files.h"
#include "tests/run/run_frame.h"

namespace wrinkle::test {
namespace {

std::vector<std::string> figure_names() {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(data_folder / "figures")) names.push_back(entry.path().stem());
    std::ranges::sort(names);
    return names;
}

/// A picture as a PNG holds it.
struct Picture {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;

    explicit Picture(const fs::path& file) {
        const auto input = OIIO::ImageInput::open(file.string());
        if (!input) throw Error(OIIO::geterror());
        width = input->spec().width, height = input->spec().height;
        rgb.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
        input->read_image(0, 0, 0, 3, OIIO::TypeUInt8, rgb.data());
    }

    /// Pixels of the columns [a, a + count) and [b, b + count) that differ, in the rows above `bottom`.
    int differences(int a, int b, int count, int bottom) const {
        int found = 0;
        for (int y = 0; y < bottom; ++y)
            for (int x = 0; x < count; ++x) found += std::abs(red(a + x, y) - red(b + x, y)) > 2;
        return found;
    }
    int red(int x, int y) const { return rgb[3 * static_cast<std::size_t>(y * width + x)]; }
};

class DataFigure : public testing::TestWithParam<std::string> {};

TEST_P(DataFigure, ShowsPanelsThatDiffer) {
    Figure figure = load_figure(data_folder / "figures" / (GetParam() + ".toml"));
    ASSERT_GE(figure.panels.size(), 2u);
    figure.columns = 0;  // all in one row, as the pixels below expect
    figure.scene.gbuffer.file = data_folder / "gbuffer/small.exr";
    figure.scene.camera.file = data_folder / "gbuffer/small.camera.json";
    const TempFolder folder;
    draw_figure(device(), figure, folder / "figure.png");
    const Picture drawn(folder / "figure.png");
    const int count = static_cast<int>(figure.panels.size()), width = (drawn.width - 6 * (count - 1)) / count;
    const int bottom = drawn.height - 24;
    EXPECT_NEAR(width, 120 * (figure.crop[2] - figure.crop[0]), 1.5);
    EXPECT_NEAR(bottom, 68 * (figure.crop[3] - figure.crop[1]), 1.5);
    for (int i = 1; i < count; ++i)
        EXPECT_GT(drawn.differences(0, i * (width + 6), width, bottom), width * bottom / 50) << "panels 1, " << i + 1;
    int dark = 0;
    for (int y = bottom; y < drawn.height; ++y)
        for (int x = 0; x < drawn.width; ++x) dark += drawn.red(x, y) < 128;
    EXPECT_GT(dark, 10) << "captions";
}

INSTANTIATE_TEST_SUITE_P(Figures, DataFigure, testing::ValuesIn(figure_names()),
                         [](const auto& info) { return info.param; });

TEST(Figure, PanelsTakeLayersInTheSceneOrder) {
    Figure figure;
    for (const char* name : {"a", "b", "c"}) figure.scene.layers.emplace_back().name = name;
    figure.scene.lighting.relight = Relight::lit;
    const Scene lit = panel_scene(figure, {.caption = {}, .layers = {"c", "a"}, .picture = PanelPicture::lit});
    ASSERT_EQ(lit.layers.size(), 2u);
    EXPECT_EQ(lit.layers[0].name, "a");
    EXPECT_EQ(lit.lighting.relight, Relight::lit);
    EXPECT_EQ(panel_scene(figure, {.caption = {}, .layers = {}, .picture = PanelPicture::normal}).lighting.relight,
              Relight::off);
}

TEST(Figure, MistakesAreReportedTogether) {
    const TempFolder folder;
    write_text(folder / "bad.toml", R"([gbuffer]
file = "nowhere.exr"
[camera]
from = "exr"
[figure]
crop = [0.5, 0, 0.5, 1]
[[layer]]
name = "dents"
kind = "constant"
gradient = [1, 0, 0]
[[panel]]
caption = "one"
layers = ["dnets"]
[[panel]]
layers = []
colour = 3
)");
    try {
        load_figure(folder / "bad.toml");
        FAIL();
    } catch (const Error& error) {
        expect_mentions(error.what(), {"nowhere.exr", "bad.toml:6", "left < right", "bad.toml:13", "dnets", "dents",
                                       "caption", "colour", "relight"});
    }
    write_text(folder / "shot.toml",
               "panel = [{ caption = \"a\", layers = [], picture = \"normal\" }]\n"
               "[gbuffer]\nfile = \"shot.####.exr\"\n[camera]\nfrom = \"exr\"\n");
    expect_mentions(error_of([&] { load_figure(folder / "shot.toml"); }), {"shot.toml:2", "one frame"});
    write_text(folder / "none.toml", "panel = []\n[gbuffer]\nfile = \"bad.toml\"\n[camera]\nfrom = \"exr\"\n");
    EXPECT_THROW(load_figure(folder / "none.toml"), Error);
    const fs::path figure = data_folder / "figures/layering.toml", scene = data_folder / "scenes/noise.toml";
    EXPECT_THROW(load_scene(figure), Error);
    EXPECT_THROW(load_figure(scene), Error);
}

}  // namespace
}  // namespace wrinkle::test
