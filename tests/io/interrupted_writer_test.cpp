// Pictures that could not be written to the end: the old file stays, and nothing else is left.
#include <sys/resource.h>
#include <sys/wait.h>
#include <csignal>

#include "tests/io/picture_bands.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

TEST(InterruptedWriter, WithoutFinishTheOldFileStays) {
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

TEST(InterruptedWriter, KillLeavesNothing) {
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

TEST(InterruptedWriter, FullDisk) {
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

TEST(InterruptedWriter, PlacesThatCannotBeWritten) {
    TempFolder folder;
    const auto open = [](const std::filesystem::path& file) { ImageWriter(file, {4, 4}, {"Z"}); };
    expect_mentions(error_of([&] { open(folder / "none/out.exr"); }), {"cannot write", "there is no folder"});
    expect_mentions(error_of([&] { open(folder / "out.jpg"); }), {".jpg", "use .exr or .png"});
    expect_mentions(error_of([&] { ImageWriter(folder / "out.png", {4, 4}, Names(5, "x")); }), {"5 channels"});
    std::filesystem::create_directory(folder / "dir.exr");
    expect_mentions(error_of([&] { open(folder / "dir.exr"); }), {"it is a folder"});
    expect_mentions(error_of([&] { open("/proc/out.exr"); }), {"the folder /proc is not writable"});
}

}  // namespace
}  // namespace wrinkle
