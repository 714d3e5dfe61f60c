#include <fmt/format.h>

#include "io/camera_file.h"
#include "tests/io/camera_frames.h"

namespace wrinkle {
namespace {

using namespace test;

std::string json_matrix(const Mat4& m) {
    std::string text = "[";
    for (std::size_t i = 0; i < 4; ++i)
        text += fmt::format("{}[{}, {}, {}, {}]", i == 0 ? "" : ", ", m[i][0], m[i][1], m[i][2], m[i][3]);
    return text + "]";
}

TEST(CameraJson, IsReadAndChecked) {
    TempFolder folder;
    write_frame(folder / "f.0012.exr", {}, plain_names);
    const GBufferReader reader(folder / "f.0012.exr");
    CameraSource source;
    source.file = folder / "f.####.json";
    const auto file = folder / "f.0012.json";
    const auto view = json_matrix(true_camera().view), proj = json_matrix(true_camera().proj);
    const auto complaint = [&](const std::string& text) {
        write_text(file, text);
        return error_of([&] { read_camera(source, reader, 12); });
    };
    expect_mentions(error_of([&] { read_camera(source, reader, 12); }), {"f.0012.json: there is no such file"});
    expect_mentions(complaint("{\"view\": [\n1,"), {"malformed", "line 2"});
    expect_mentions(complaint("[1, 2]"), {"not a camera file"});
    expect_mentions(complaint("{\"view\": " + view + "}"), {"\"proj\" is missing"});
    expect_mentions(complaint(R"({"view": [[1,2],[3,4]], "proj": 3})"), {"\"view\" is 2 rows", "4 rows of 4"});
    expect_mentions(complaint("{\"view\": " + view + R"(, "proj": [[1,0,0,0],[0,1,0,0],[0,0,"x",0],[0,0,1,0]]})"),
                    {"\"proj\" is no number in row 2, column 2"});
    expect_mentions(complaint("{\"view\": " + view + ",\n\"proj\": [[1e999,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,1,0]]}"),
                    {"f.0012.json", "line 2", "out of range", "1e999"});
    expect_mentions(
        complaint("{\"view\": " + json_matrix(transposed(true_camera().view)) + ", \"proj\": " + proj + "}"),
        {"view is transposed"});
    expect_mentions(complaint("{\"view\": [[2,0,0,0],[0,2,0,0],[0,0,2,0],[0,0,0,1]], \"proj\": " + proj + "}"),
                    {"view must be rigid"});
    expect_mentions(complaint("{\"view\": " + view + ", \"proj\": [[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,-1,0]]}"),
                    {"proj is singular"});
    expect_mentions(complaint(fmt::format(R"({{"width": 96, "height": 96, "view": {}, "proj": {}}})", view, proj)),
                    {"the camera is for 96x96 and the frame is 96x54"});
    write_text(file, fmt::format(R"({{"width": 192, "height": 108, "view": {}, "proj": {}}})", view, proj));
    expect_same(read_camera(source, reader, 12), 1e-12);
    Mat4 rounded = true_camera().view;
    rounded[3] = {1e-7, 0, -1e-7, 1.0000001};
    write_text(file, "{\"view\": " + json_matrix(rounded) + ", \"proj\": " + proj + "}");
    expect_same(read_camera(source, reader, 12), 1e-12);
    rounded[3] = {0, 0, 0, 1.01};
    expect_mentions(complaint("{\"view\": " + json_matrix(rounded) + ", \"proj\": " + proj + "}"),
                    {"view must have the last row [0, 0, 0, 1]; found [0, 0, 0, 1.01]"});
}

}  // namespace
}  // namespace wrinkle
