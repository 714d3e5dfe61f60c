#include "tests/io/files.h"

#include "io/gbuffer_reader.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

GBufferSource of(const std::filesystem::path& file, const std::string& view = "") {
    GBufferSource source;
    source.file = file;
    source.view = view;
    return source;
}

GBufferReader open(const std::filesystem::path& file, const std::string& view = "") {
    return GBufferReader(file, of(file, view));
}

/// The first pixel of a plane.
float first(const GBufferReader& reader, const std::string& plane) {
    std::vector<float> row(reader.size().width);
    const std::vector<std::string> planes{plane};
    const std::vector<float*> out{row.data()};
    reader.read_rows(0, 1, planes, out);
    return row[0];
}

PartSpec part(const std::string& name, const std::string& view, Names channels, float offset) {
    auto spec = make_spec(4, 4, std::move(channels));
    spec.attribute("oiio:subimagename", name);
    if (!view.empty()) spec.attribute("view", view);
    return {spec, [offset](int c, int, int) { return offset + static_cast<float>(c); }};
}

TEST(Views, PartsOfAnotherViewAreNotThere) {
    TempFolder folder;
    const Names channels{"Z", "N.X", "N.Y", "N.Z"};
    write_image(folder / "a.exr", {part("left", "left", channels, 10), part("right", "right", channels, 20)});
    const auto left = open(folder / "a.exr"), right = open(folder / "a.exr", "right");
    EXPECT_EQ(left.views(), (Names{"left", "right"}));
    EXPECT_EQ(left.view(), "left");
    EXPECT_EQ(left.channels(), channels);
    EXPECT_EQ(right.channels(), channels);
    EXPECT_EQ(first(left, "normal.y"), 12);
    EXPECT_EQ(first(right, "normal.y"), 22);
    EXPECT_EQ(first(right, "depth"), 20);
    expect_mentions(error_of([&] { open(folder / "a.exr", "centre"); }), {"no view \"centre\"", "\"left\", \"right\""});
}

TEST(Views, AnotherEyesCameraIsNotTaken) {
    TempFolder folder;
    const Names channels{"Z", "N.X", "N.Y", "N.Z"};
    std::vector<PartSpec> parts{part("left", "left", channels, 10), part("right", "right", channels, 20)};
    for (std::size_t eye = 0; eye < 2; ++eye) {
        float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, eye == 0 ? 0.0f : 7.0f, 0, 0, 1};
        parts[eye].spec.attribute("worldToCamera", OIIO::TypeMatrix44, matrix);
    }
    write_image(folder / "a.exr", parts);
    const auto matrix_of = [&](const std::string& view) {
        return open(folder / "a.exr", view).metadata().matrix("worldToCamera").value();
    };
    EXPECT_NE(matrix_of("left"), matrix_of("right"));
    EXPECT_EQ(matrix_of("right")[3][0] + matrix_of("right")[0][3], 7);
}

TEST(Views, PartsNamedByTheirEyeNeedNoAttribute) {
    TempFolder folder;
    write_image(folder / "a.exr", {part("N.right", "", {"X", "Y", "Z"}, 20), part("N.left", "", {"X", "Y", "Z"}, 10),
                                   part("crypto", "", {"crypto00.R"}, 50)});
    const auto reader = open(folder / "a.exr", "Left");
    EXPECT_EQ(reader.channels(), (Names{"N.X", "N.Y", "N.Z", "crypto00.R"}));  // what names no view is of both
    EXPECT_EQ(first(reader, "normal.x"), 10);
}

TEST(Views, NukesOnlyViewIsNoLayer) {
    TempFolder folder;
    write_image(folder / "a.exr", {part("rgba.main", "", {"red", "green", "blue"}, 1),
                                   part("N.main", "", {"red", "green", "blue"}, 20), part("depth.main", "", {"Z"}, 5)});
    const auto reader = open(folder / "a.exr");
    EXPECT_EQ(first(reader, "normal.y"), 21);
    EXPECT_EQ(first(reader, "depth"), 5);
    EXPECT_EQ(first(reader, "beauty.b"), 3);
}

TEST(Views, ChannelsOfOnePartByTheAttributeMultiView) {
    TempFolder folder;
    auto spec = make_spec(4, 4, {"N.X", "N.Y", "N.Z", "N.wide.X", "N.wide.Y", "N.wide.Z", "Z", "wide.Z"});
    const char* views[] = {"main", "wide"};
    spec.attribute("multiView", OIIO::TypeDesc(OIIO::TypeDesc::STRING, 2), views);
    write_image(folder / "a.exr", {{spec, [](int c, int, int) { return static_cast<float>(c); }}});
    const auto main = open(folder / "a.exr"), wide = open(folder / "a.exr", "wide");
    EXPECT_EQ(main.view(), "main");
    EXPECT_EQ(main.channels().size(), 4u);
    EXPECT_EQ(wide.channels().size(), 4u);
    EXPECT_EQ(first(wide, "normal.z") - first(main, "normal.z"), first(wide, "normal.x") - first(main, "normal.x"));
    EXPECT_NE(first(wide, "depth"), first(main, "depth"));
}

TEST(Views, LeftAndRightWithoutAnyAttribute) {
    TempFolder folder;
    write_exr(folder / "a.exr", 4, 4, {"left.N.X", "left.N.Y", "left.N.Z", "right.N.X", "right.N.Y", "right.N.Z"});
    EXPECT_EQ(open(folder / "a.exr").channels(), (Names{"N.X", "N.Y", "N.Z"}));
    write_exr(folder / "b.exr", 4, 4, {"N.X", "N.Y", "N.Z", "right.N.X", "right.N.Y", "right.N.Z"});
    EXPECT_EQ(open(folder / "b.exr").view(), "left");
    EXPECT_EQ(open(folder / "b.exr", "right").channels(), (Names{"N.X", "N.Y", "N.Z"}));
    write_exr(folder / "c.exr", 4, 4, {"left_arm.X", "left_arm.Y", "left_arm.Z"});
    EXPECT_TRUE(open(folder / "c.exr").views().empty());
    expect_mentions(error_of([&] { open(folder / "c.exr", "left"); }), {"the file has no views"});
}

TEST(Parts, LayersThatOnlyThePartsNameHas) {
    TempFolder folder;
    const Names rgb{"R", "G", "B"}, words{"red", "green", "blue"};
    write_image(folder / "houdini.exr", {part("N", "", rgb, 1), part("P", "", rgb, 10), part("C", "", rgb, 20)});
    const auto houdini = open(folder / "houdini.exr");
    EXPECT_EQ(first(houdini, "normal.z"), 3);
    EXPECT_EQ(first(houdini, "position.x"), 10);
    EXPECT_EQ(first(houdini, "beauty.r"), 20);
    write_image(folder / "nuke.exr", {part("rgba.main", "main", {"R", "G", "B", "Z"}, 30),
                                      part("N.main", "main", words, 1), part("P.main", "main", words, 10)});
    const auto nuke = open(folder / "nuke.exr");
    EXPECT_EQ(first(nuke, "depth"), 33);
    EXPECT_EQ(first(nuke, "normal.y"), 2);
    EXPECT_EQ(first(nuke, "position.y"), 11);
    EXPECT_EQ(first(nuke, "beauty.b"), 32);
}

}  // namespace
}  // namespace wrinkle
