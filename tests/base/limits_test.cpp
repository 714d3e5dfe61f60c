#include "base/limits.h"

#include <gtest/gtest.h>

#include "base/claim.h"
#include "base/input_file.h"
#include "base/text_file.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using test::error_of, test::expect_mentions;

/// What one test sets is no limit of the others.
class MemoryLimits : public ::testing::Test {
protected:
    ~MemoryLimits() override { set_limits({}); }
};

TEST_F(MemoryLimits, CountWhatIsTaken) {
    EXPECT_GT(memory_limit().taken, 1e6);
    set_limits({.memory = std::uint64_t{1} << 30, .sandbox = {}, .volume_reader = {}});
    const double before = memory_limit().taken;
    EXPECT_EQ(memory_limit().whose, "--memory");
    check_memory("frame.exr", 7e8, "its planes");
    const std::vector<char> held(std::size_t{600} << 20, 1);
    EXPECT_GT(memory_limit().taken, before + 5e8);
    expect_mentions(error_of([] { check_memory("frame.exr", 7e8, "its planes"); }),
                    {"frame.exr: its planes would take 700 MB of memory beside the ", " in use; the limit of --memory",
                     "is 1.1 GB"});
    check_memory("frame.exr", kHarmless, "a little");
}

/// A file of any length that takes no disk.
TEST_F(MemoryLimits, BoundFilesBeforeTheyAreRead) {
    const test::TempFolder folder;
    test::write_text(folder / "scene.toml", "");
    std::filesystem::resize_file(folder / "scene.toml", std::uintmax_t{1} << 40);
    expect_mentions(error_of([&] { read_text(folder / "scene.toml", "a scene file"); }),
                    {"scene.toml: it is longer than 64.0 MB"});
    expect_mentions(error_of([&] { read_text(folder / "scene.toml", "a table", kAnyLength); }),
                    {"scene.toml: all of it would take 1.1 TB of memory"});
}

}  // namespace
}  // namespace wrinkle
