#include "base/atomic_file.h"

#include "tests/io/files.h"

namespace wrinkle {
namespace {

using namespace test;
using Names = std::vector<std::string>;

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

}  // namespace
}  // namespace wrinkle
