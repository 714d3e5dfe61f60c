#include "base/temporary_name.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/wait.h>

#include <set>

#include "base/atomic_file.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

using test::TempFolder;
namespace fs = std::filesystem;

constexpr auto kNamed = AtomicFile::Temporary::named;

std::size_t partial_files(const TempFolder& folder) {
    std::size_t count = 0;
    for (const std::string& name : folder.files()) count += name.ends_with(".partial") ? 1 : 0;
    return count;
}

TEST(TemporaryName, IsNewEachTime) {
    std::set<fs::path> names;
    for (int i = 0; i < 1000; ++i) names.insert(temporary_name("folder/a.exr"));
    EXPECT_EQ(names.size(), 1000u);
    for (const auto& name : names) EXPECT_TRUE(name.string().starts_with("folder/.a.exr.")) << name;
}

TEST(TemporaryName, ThoseOfTheDeadAreRemoved) {
    const TempFolder folder;
    test::write_text(folder / ".a.exr.123-1.partial", "of an earlier version");
    test::write_text(folder / ".a.exr.0123456789ab.partial", "of a killed one");
    test::write_text(folder / ".b.exr.0123456789ab.partial", "of another file");
    test::write_text(folder / "a.exr.partial", "not ours");
    const AtomicFile living(folder / "a.exr", kNamed);
    EXPECT_EQ(partial_files(folder), 3u);
    AtomicFile second(folder / "a.exr", kNamed);
    EXPECT_EQ(partial_files(folder), 4u) << "one that is being written stays";
    second.write("two");
    second.commit();
    EXPECT_EQ(partial_files(folder), 3u);
    EXPECT_TRUE(fs::exists(folder / "a.exr.partial"));
    EXPECT_TRUE(fs::exists(folder / ".b.exr.0123456789ab.partial"));
}

/// What a process of its own does with a named file until a signal ends it. Gives the signal.
int ended_by(int signal, const fs::path& file, bool handled) {
    const pid_t child = ::fork();
    if (child == 0) {
        if (handled) remove_temporaries_on_signals();
        AtomicFile one(file, kNamed), two(file, kNamed);
        one.write("some of it");
        ::raise(signal);
        ::_exit(0);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

TEST(TemporaryName, SignalsLeaveNothing) {
    const TempFolder folder;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        EXPECT_EQ(ended_by(signal, folder / "a.exr", true), signal);
        EXPECT_TRUE(folder.files().empty()) << signal;
    }
}

/// Where no handler runs, the next writer cleans up. In containers all of them have the same process number.
TEST(TemporaryName, KillsLeaveNothingForLong) {
    const TempFolder folder;
    for (int i = 0; i < 100; ++i) {
        EXPECT_EQ(ended_by(SIGKILL, folder / "a.exr", true), SIGKILL);
        EXPECT_EQ(partial_files(folder), 2u);
    }
    {
        AtomicFile file(folder / "a.exr", kNamed);
        file.write("all of it");
        file.commit();
    }
    EXPECT_EQ(folder.files(), std::vector<std::string>{"a.exr"});
}

}  // namespace
}  // namespace wrinkle
