#pragma once

#include <OpenImageIO/imageio.h>

#include <gtest/gtest.h>
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "wrinkle/error.h"

/// Small image files for the tests of host/io.
namespace wrinkle::test {

/// A folder for one test, deleted afterwards.
class TempFolder {
public:
    TempFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "wrinkle_io_XXXXXX").string();
        path_ = ::mkdtemp(pattern.data());
    }
    ~TempFolder() { std::filesystem::remove_all(path_); }
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    std::vector<std::string> files() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

private:
    std::filesystem::path path_;
};

/// Value of a channel at a pixel.
using Pixel = std::function<float(int channel, int x, int y)>;

/// A number that differs in every channel and pixel and is exact as a half: 100 c + x + y / 64.
inline float numbered(int channel, int x, int y) {
    return static_cast<float>(100 * channel + x) + static_cast<float>(y) / 64.0f;
}

struct PartSpec {
    OIIO::ImageSpec spec;
    Pixel pixel = numbered;
};

inline OIIO::ImageSpec make_spec(int width, int height, std::vector<std::string> channels,
                                 OIIO::TypeDesc type = OIIO::TypeFloat) {
    OIIO::ImageSpec spec(width, height, static_cast<int>(channels.size()), type);
    spec.channelnames = std::move(channels);
    spec.attribute("compression", "zip");
    return spec;
}

inline void write_image(const std::filesystem::path& file, const std::vector<PartSpec>& parts) {
    auto output = OIIO::ImageOutput::create(file.string());
    ASSERT_TRUE(output) << OIIO::geterror();
    std::vector<OIIO::ImageSpec> specs;
    for (const auto& part : parts) specs.push_back(part.spec);
    ASSERT_TRUE(specs.size() == 1 ? output->open(file.string(), specs[0])
                                  : output->open(file.string(), static_cast<int>(specs.size()), specs.data()))
        << output->geterror();
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const auto& spec = parts[p].spec;
        if (p > 0) { ASSERT_TRUE(output->open(file.string(), spec, OIIO::ImageOutput::AppendSubimage)); }
        std::vector<float> values;
        for (int y = 0; y < spec.height; ++y)
            for (int x = 0; x < spec.width; ++x)
                for (int c = 0; c < spec.nchannels; ++c) values.push_back(parts[p].pixel(c, x, y));
        ASSERT_TRUE(output->write_image(OIIO::TypeFloat, values.data())) << output->geterror();
    }
    ASSERT_TRUE(output->close()) << output->geterror();
}

inline void write_exr(const std::filesystem::path& file, int width, int height, std::vector<std::string> channels,
                      Pixel pixel = numbered, OIIO::TypeDesc type = OIIO::TypeFloat) {
    write_image(file, {{make_spec(width, height, std::move(channels), type), std::move(pixel)}});
}

inline void write_text(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

/// The message of the Error that `action` throws. The test fails when it throws none.
template <typename Action>
std::string error_of(Action&& action) {
    try {
        action();
    } catch (const Error& error) { return error.what(); }
    ADD_FAILURE() << "expected a wrinkle::Error";
    return "";
}

inline void expect_mentions(const std::string& text, const std::vector<std::string>& parts) {
    for (const auto& part : parts) {
        EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in: " << text;
    }
}

inline const std::vector<std::string> blender_channels{
    "ViewLayer.Combined.R",
    "ViewLayer.Combined.G",
    "ViewLayer.Combined.B",
    "ViewLayer.Combined.A",
    "ViewLayer.CryptoObject00.r",
    "ViewLayer.CryptoObject00.g",
    "ViewLayer.CryptoObject00.b",
    "ViewLayer.CryptoObject00.a",
    "ViewLayer.CryptoObject01.r",
    "ViewLayer.CryptoObject01.g",
    "ViewLayer.CryptoObject01.b",
    "ViewLayer.CryptoObject01.a",
    "ViewLayer.Depth.Z",
    "ViewLayer.IndexOB.X",
    "ViewLayer.Normal.X",
    "ViewLayer.Normal.Y",
    "ViewLayer.Normal.Z",
    "ViewLayer.Position.X",
    "ViewLayer.Position.Y",
    "ViewLayer.Position.Z",
    "ViewLayer.UV.A",
    "ViewLayer.UV.U",
    "ViewLayer.UV.V",
};

}  // namespace wrinkle::test
