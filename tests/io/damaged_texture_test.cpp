// Textures that cannot be used: what is told of them.
#include <cmath>
#include <limits>

#include "io/texture_file.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;

// What is missing of these would be read as grey or black.
TEST(DamagedTexture, TruncatedFilesOfFormatsWhoseReadersFillThem) {
    TempFolder folder;
    const auto noise = [](int, int x, int y) { return static_cast<float>(x * y * 7919 % 251) / 251; };
    for (const char* name : {"cut.jpg", "cut.tif", "cut.tga"}) {
        write_exr(folder / name, 64, 64, {"R", "G", "B"}, noise, OIIO::TypeUInt8);
        EXPECT_NO_THROW(load_texture(folder / name, ImageUse::scalar)) << name;
        std::filesystem::resize_file(folder / name, std::filesystem::file_size(folder / name) * 6 / 10);
        expect_mentions(error_of([&] { load_texture(folder / name, ImageUse::scalar); }), {name, "truncated"});
    }
    std::string dds(128 + 16 * 16 * 4, '\0');
    const std::vector<std::pair<std::size_t, std::uint32_t>> header{
        {0, 0x20534444}, {4, 124},   {8, 0x1007},  {12, 16},        {16, 16},          {76, 32},     {80, 0x41},
        {88, 32},        {92, 0xff}, {96, 0xff00}, {100, 0xff0000}, {104, 0xff000000}, {108, 0x1000}};
    for (const auto& [at, word] : header)
        for (std::size_t i = 0; i < 4; ++i) dds[at + i] = static_cast<char>(word >> (8 * i));
    write_text(folder / "whole.dds", dds);
    EXPECT_NO_THROW(load_texture(folder / "whole.dds", ImageUse::scalar));
    write_text(folder / "cut.dds", dds.substr(0, 700));
    expect_mentions(error_of([&] { load_texture(folder / "cut.dds", ImageUse::scalar); }),
                    {"cut.dds: the DDS is truncated: 700 bytes of at least 1152"});
    dds[80] = 4;
    dds.replace(84, 4, "DX10");
    dds[128] = 83;
    write_text(folder / "bc5.dds", dds);
    expect_mentions(error_of([&] { load_texture(folder / "bc5.dds", ImageUse::normal); }),
                    {"bc5.dds: a DDS of the kind DX10 (DXGI format 83)", "save it as PNG"});
}

TEST(DamagedTexture, NanAndInfNameTheirPixel) {
    TempFolder folder;
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
        write_exr(folder / "bad.exr", 8, 6, {"Y"}, [&](int, int x, int y) { return x == 5 && y == 2 ? bad : 0.5f; });
        expect_mentions(error_of([&] { load_texture(folder / "bad.exr", ImageUse::scalar); }),
                        {"bad.exr: pixel (5, 2) from the top left is", std::isnan(bad) ? "NaN" : "infinite"});
    }
}

TEST(DamagedTexture, DamagedFiles) {
    TempFolder folder;
    expect_mentions(error_of([&] { load_texture(folder / "none.png", ImageUse::scalar); }),
                    {"none.png: there is no such file"});
    write_text(folder / "empty.png", "");
    expect_mentions(error_of([&] { load_texture(folder / "empty.png", ImageUse::scalar); }), {"is empty"});
    write_text(folder / "text.png", "no png");
    expect_mentions(error_of([&] { load_texture(folder / "text.png", ImageUse::scalar); }), {"not an image"});
    write_exr(
        folder / "cut.png", 64, 64, {"Y"},
        [](int, int x, int y) { return static_cast<float>(x * y * 7919 % 251) / 251; }, OIIO::TypeUInt8);
    std::filesystem::resize_file(folder / "cut.png", std::filesystem::file_size(folder / "cut.png") / 2);
    expect_mentions(error_of([&] { load_texture(folder / "cut.png", ImageUse::scalar); }), {"cut.png:", "truncated"});
}

}  // namespace
}  // namespace wrinkle
