#include "io/image_writer.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <bit>
#include <cmath>
#include <csignal>
#include <limits>

#include "base/atomic_file.h"
#include "io/gbuffer_reader.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

constexpr std::uint32_t width = 45, height = 67;

/// Planes of a whole picture, from which bands are written.
std::vector<std::vector<float>> planes_of(int channels) {
    std::vector<std::vector<float>> planes(static_cast<std::size_t>(channels));
    for (int c = 0; c < channels; ++c)
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x)
                planes[static_cast<std::size_t>(c)].push_back(numbered(c, static_cast<int>(x), static_cast<int>(y)));
    return planes;
}

void write_band(ImageWriter& writer, const std::vector<std::vector<float>>& planes, std::uint32_t begin,
                std::uint32_t end) {
    std::vector<const float*> band;
    for (const auto& plane : planes) band.push_back(plane.data() + begin * width);
    writer.write_rows(begin, end, band);
}

std::vector<float> read_channel(const std::filesystem::path& file, const std::string& channel) {
    const GBufferReader reader(file);
    std::vector<float> values(std::size_t{reader.size().width} * reader.size().height);
    float* out[] = {values.data()};
    reader.read_rows(0, reader.size().height, Names{"channel:" + channel}, out);
    return values;
}

TEST(ImageWriter, BandsOfAnySizeMakeTheSameFile) {
    TempFolder folder;
    const auto planes = planes_of(4);
    ImageOptions options;
    options.metadata.set("wrinkle:scene", "a scene");
    ImageWriter writer(folder / "out.exr", {width, height}, {"normal.x", "normal.y", "normal.z", "marked"}, options);
    for (const auto& [begin, end] : {std::pair{0u, 1u}, {1u, 33u}, {33u, 33u}, {33u, height}}) {
        write_band(writer, planes, begin, end);
    }
    EXPECT_TRUE(folder.files().empty()) << "nothing is seen before finish()";
    writer.finish();
    EXPECT_EQ(folder.files(), Names{"out.exr"});
    EXPECT_EQ(read_channel(folder / "out.exr", "normal.y"), planes[1]);
    EXPECT_EQ(read_channel(folder / "out.exr", "marked"), planes[3]);
    EXPECT_EQ(GBufferReader(folder / "out.exr").metadata().text("wrinkle:scene"), "a scene");
    EXPECT_EQ(GBufferReader(folder / "out.exr").metadata().text("compression"), "zip");
}

TEST(ImageWriter, MetadataOfTheInputIsCopiedButNotItsStorage) {
    // OpenImageIO renames V-Ray's cameraTransform on reading and again on writing.
    for (const std::string camera : {"worldToCamera", "cameraTransform"}) {
        TempFolder folder;
        auto spec = make_spec(4, 4, {"Z"});
        const float values[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 5, 0, 1};
        spec.attribute(camera, OIIO::TypeMatrix44, values);
        spec.attribute("compression", "piz");
        spec.attribute("Scene", "courtyard");
        write_image(folder / "in.exr", {{spec}});
        ImageOptions options;
        options.metadata = GBufferReader(folder / "in.exr").metadata();
        ImageWriter writer(folder / "out.exr", {4, 4}, {"Z"}, options);
        const std::vector<float> plane(16, 1.0f);
        const float* planes[] = {plane.data()};
        writer.write_rows(0, 4, planes);
        writer.finish();
        const auto metadata = GBufferReader(folder / "out.exr").metadata();
        EXPECT_EQ(metadata.text("compression"), "zip");
        EXPECT_EQ(metadata.text("Scene"), "courtyard");
        const auto matrix = metadata.matrix(camera);
        ASSERT_TRUE(matrix) << camera;
        EXPECT_EQ((*matrix)[3][1], 5) << camera;
    }
}

TEST(ImageWriter, HalfKeepsFiniteValuesFiniteAndCryptomattesWhole) {
    TempFolder folder;
    const float id = std::bit_cast<float>(0xf9fa0452u);
    const std::vector<float> depth{1e10f, -1e10f, std::numeric_limits<float>::infinity(), 0.25f}, ids(4, id);
    ImageOptions options;
    options.half = true;
    ImageWriter writer(folder / "half.exr", {2, 2}, {"Z", "CryptoObject00.R"}, options);
    const float* planes[] = {depth.data(), ids.data()};
    writer.write_rows(0, 2, planes);
    writer.finish();
    EXPECT_EQ(read_channel(folder / "half.exr", "Z"),
              (std::vector<float>{65504, -65504, std::numeric_limits<float>::infinity(), 0.25f}));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(read_channel(folder / "half.exr", "CryptoObject00.R")[3]), 0xf9fa0452u);
}

TEST(ImageWriter, PngEncodings) {
    TempFolder folder;
    const auto encode = [&](PngEncoding encoding, double exposure, std::vector<float> values) {
        ImageOptions options;
        options.png = encoding;
        options.exposure = exposure;
        ImageWriter writer(folder / "p.png", {static_cast<std::uint32_t>(values.size()), 1}, {"R", "G", "B"}, options);
        const float* planes[] = {values.data(), values.data(), values.data()};
        writer.write_rows(0, 1, planes);
        writer.finish();
        std::vector<int> bytes;
        for (const float value : read_channel(folder / "p.png", "G"))
            bytes.push_back(static_cast<int>(std::lround(value * 255)));
        return bytes;
    };
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    EXPECT_EQ(encode(PngEncoding::srgb, 0, {0, 0.5f, 1, 7, -1, nan, inf}), (std::vector{0, 188, 255, 255, 0, 0, 255}));
    EXPECT_EQ(encode(PngEncoding::srgb, 1, {0.25f}), std::vector{188});
    EXPECT_EQ(encode(PngEncoding::linear, 3, {0.2f, 2}), (std::vector{51, 255}));
    EXPECT_EQ(encode(PngEncoding::normal, 0, {-1, 0.2f, 1}), (std::vector{0, 153, 255}));
}

TEST(ImageWriter, PngRowsAreTopFirst) {
    TempFolder folder;
    ImageOptions options;
    options.png = PngEncoding::linear;
    ImageWriter writer(folder / "p.png", {1, 2}, {"Y"}, options);
    const float values[] = {1, 0};
    const float* planes[] = {values};
    writer.write_rows(0, 2, planes);
    writer.finish();
    EXPECT_EQ(read_channel(folder / "p.png", "Y"), (std::vector<float>{1, 0}));
}

TEST(ImageWriter, WithoutFinishTheOldFileStays) {
    TempFolder folder;
    write_text(folder / "out.exr", "old");
    {
        ImageWriter writer(folder / "out.exr", {width, height}, {"Z"});
        write_band(writer, planes_of(1), 0, 40);
    }
    EXPECT_EQ(folder.files(), Names{"out.exr"});
    EXPECT_EQ(std::filesystem::file_size(folder / "out.exr"), 3u);
    ImageWriter writer(folder / "out.exr", {width, height}, {"Z"});
    write_band(writer, planes_of(1), 0, 40);
    expect_mentions(error_of([&] { writer.finish(); }), {"only 40 of 67 rows", "the old file is unchanged"});
    expect_mentions(error_of([&] { write_band(writer, planes_of(1), 41, 50); }), {"row 40"});
    write_band(writer, planes_of(1), 40, height);
    writer.finish();
    EXPECT_EQ(folder.files(), Names{"out.exr"});
    EXPECT_EQ(read_channel(folder / "out.exr", "Z"), planes_of(1)[0]);
}

TEST(ImageWriter, KillLeavesNothing) {
    TempFolder folder;
    const auto child = ::fork();
    if (child == 0) {
        OIIO::attribute("threads", 1);  // a forked process has no threads of its parent's pool
        ImageWriter writer(folder / "out.png", {width, height}, {"Z"});
        write_band(writer, planes_of(1), 0, 40);
        ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_TRUE(folder.files().empty());
}

/// While it lives, no file can grow beyond so many bytes, which looks like a full disk to the writer.
class DiskOf {
public:
    explicit DiskOf(rlim_t bytes) : old_handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &old_);
        const rlimit limit{bytes, old_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~DiskOf() {
        ::setrlimit(RLIMIT_FSIZE, &old_);
        std::signal(SIGXFSZ, old_handler_);
    }

private:
    rlimit old_{};
    void (*old_handler_)(int);
};

TEST(ImageWriter, FullDisk) {
    for (const std::string name : {"out.exr", "out.png"}) {
        TempFolder folder;
        write_text(folder / name, "old");
        std::string text;
        {
            const DiskOf disk(4096);
            text = error_of([&] {
                ImageWriter writer(folder / name, {width, 40 * height}, {"R", "G", "B"});
                std::vector<float> noise(std::size_t{width} * height);
                for (std::size_t i = 0; i < noise.size(); ++i) noise[i] = static_cast<float>(i * 7919 % 10007) / 10007;
                const float* planes[] = {noise.data(), noise.data(), noise.data()};
                for (std::uint32_t band = 0; band < 40; ++band)
                    writer.write_rows(band * height, (band + 1) * height, planes);
                writer.finish();
            });
        }
        expect_mentions(text, {"cannot write", name, "File too large", "the old file is unchanged"});
        EXPECT_EQ(folder.files(), Names{name});
        EXPECT_EQ(std::filesystem::file_size(folder / name), 3u);
    }
}

TEST(ImageWriter, PlacesThatCannotBeWritten) {
    TempFolder folder;
    const auto open = [](const std::filesystem::path& file) { ImageWriter(file, {4, 4}, {"Z"}); };
    expect_mentions(error_of([&] { open(folder / "none/out.exr"); }), {"cannot write", "there is no folder"});
    expect_mentions(error_of([&] { open(folder / "out.jpg"); }), {".jpg", "use .exr or .png"});
    expect_mentions(error_of([&] { ImageWriter(folder / "out.png", {4, 4}, Names(5, "x")); }), {"5 channels"});
    std::filesystem::create_directory(folder / "dir.exr");
    expect_mentions(error_of([&] { open(folder / "dir.exr"); }), {"it is a folder"});
    expect_mentions(error_of([&] { open("/proc/out.exr"); }), {"the folder /proc is not writable"});
}

TEST(AtomicFile, NamedTemporariesAreRemovedToo) {
    TempFolder folder;
    const auto write = [](const AtomicFile& file) { return ::write(file.descriptor(), "new!", 4) == 4; };
    write_text(folder / "a", "old");
    {
        AtomicFile file(folder / "a", AtomicFile::Temporary::named);
        EXPECT_TRUE(write(file));
        EXPECT_EQ(folder.files().size(), 2u);
    }
    EXPECT_EQ(folder.files(), Names{"a"});
    EXPECT_EQ(std::filesystem::file_size(folder / "a"), 3u);
    for (const auto temporary : {AtomicFile::Temporary::named, AtomicFile::Temporary::unnamed_if_possible}) {
        for (const std::string name : {"a", "fresh"}) {
            std::filesystem::create_symlink("a", folder / "link");
            AtomicFile file(folder / (name == "a" ? "link" : name), temporary);
            EXPECT_TRUE(write(file));
            file.commit();
            EXPECT_EQ(std::filesystem::file_size(folder / name), 4u);
            EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
            std::filesystem::remove(folder / "link");
        }
        EXPECT_EQ(folder.files(), (Names{"a", "fresh"}));
        std::filesystem::remove(folder / "fresh");
    }
}

TEST(ImageWriter, IntegersAreStoredAsSuch) {
    TempFolder folder;
    for (const bool half : {false, true}) {
        ImageOptions options;
        options.half = half;
        options.whole = {"id"};
        const std::vector<std::uint32_t> numbers{0, 16777217, 4294967295u};
        std::vector<float> bits, values{1, 2.5f, -3};
        for (const std::uint32_t number : numbers) bits.push_back(std::bit_cast<float>(number));
        ImageWriter writer(folder / "o.exr", {3, 1}, {"id", "N.X"}, options);
        const std::vector<const float*> planes{bits.data(), values.data()};
        writer.write_rows(0, 1, planes);
        writer.finish();
        const GBufferReader reader(folder / "o.exr");
        EXPECT_EQ(reader.channel_type("id"), ChannelType::whole);
        EXPECT_EQ(reader.channel_type("N.X"), half ? ChannelType::half : ChannelType::single);
        std::vector<float> read_bits(3), read_values(3);
        const std::vector<std::string> names{"bits:id", "channel:N.X"};
        const std::vector<float*> out{read_bits.data(), read_values.data()};
        reader.read_rows(0, 1, names, out);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(std::bit_cast<std::uint32_t>(read_bits[i]), numbers[i]);
        EXPECT_EQ(read_values, values);
    }
}

TEST(ImageWriter, OverscanIsKeptInExrAndCutOffInPng) {
    TempFolder folder;
    ImageOptions options;
    options.window = FrameWindow{-1, -2, {3, 2}};
    options.png = PngEncoding::linear;
    std::vector<float> pixels;
    for (int i = 0; i < 6 * 5; ++i) pixels.push_back(static_cast<float>(i) / 32);
    for (const char* name : {"o.exr", "o.png"}) {
        ImageWriter writer(folder / name, {6, 5}, {"Y"}, options);
        for (std::uint32_t row = 0; row < 5; ++row) {
            const std::vector<const float*> planes{pixels.data() + 6 * row};
            writer.write_rows(row, row + 1, planes);
        }
        writer.finish();
        auto input = OIIO::ImageInput::open((folder / name).string());
        ASSERT_TRUE(input);
        const auto& spec = input->spec();
        const bool exr = std::string(name) == "o.exr";
        EXPECT_EQ(spec.width, exr ? 6 : 3);
        EXPECT_EQ(spec.height, exr ? 5 : 2);
        EXPECT_EQ(spec.x, exr ? -1 : 0);
        EXPECT_EQ(spec.y, exr ? -2 : 0);
        EXPECT_EQ(spec.full_width, 3);
        std::vector<float> read(static_cast<std::size_t>(spec.width * spec.height));
        ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeFloat, read.data()));
        EXPECT_NEAR(read[0], exr ? pixels[0] : pixels[2 * 6 + 1], 1e-2);
        EXPECT_NEAR(read.back(), exr ? pixels.back() : pixels[3 * 6 + 3], 1e-2);
    }
}

}  // namespace
}  // namespace wrinkle
