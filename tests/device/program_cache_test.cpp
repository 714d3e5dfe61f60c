// The cache of built programs: where it is, and that it does not grow without end.
#include "device/program_cache.h"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/device/environment.h"
#include "tests/io/files.h"

namespace wrinkle {
namespace {

namespace fs = std::filesystem;
using test::TempFolder, test::Variable;

TEST(Cache, FolderComesFromTheEnvironment) {
    const Variable home("HOME", "/somewhere"), cache("XDG_CACHE_HOME", ""), own("WRINKLE_CACHE_DIR", "");
    EXPECT_EQ(cache_folder(), "/somewhere/.cache/wrinkle");
    const Variable set("XDG_CACHE_HOME", "/cache");
    EXPECT_EQ(cache_folder(), "/cache/wrinkle");
    const Variable mine("WRINKLE_CACHE_DIR", "/mine");
    EXPECT_EQ(cache_folder(), "/mine");
}

TEST(Cache, LongestUnusedProgramsGoFirst) {
    const TempFolder folder;
    const std::string key = "k";
    const std::vector<unsigned char> binary(1000, 'x');
    const auto now = fs::file_time_type::clock::now();
    for (const int age : {3, 2, 1}) {
        const fs::path file = folder / (std::to_string(age) + ".program");
        write_program(file, key, binary);
        fs::last_write_time(file, now - std::chrono::hours(age));
    }
    const std::string unfinished = std::string(32, 'a') + ".program.123-";
    for (const char* other : {"not_ours.bin", "film.partial", "notes.program.old"}) {
        fs::copy_file(folder / "3.program", folder / other);
        fs::last_write_time(folder / other, now - std::chrono::hours(2));
    }
    for (const int age : {0, 2}) {  // files of a run that goes on, and of one that was killed
        const fs::path file = folder / (unfinished + std::to_string(age));
        fs::copy_file(folder / "3.program", file);
        fs::last_write_time(file, now - std::chrono::hours(age));
    }
    EXPECT_EQ(read_program(folder / "3.program", key), binary);  // makes it the one used last
    write_program(folder / "0.program", key, binary, 2500);
    EXPECT_TRUE(fs::exists(folder / "0.program"));
    EXPECT_TRUE(fs::exists(folder / "3.program"));
    EXPECT_FALSE(fs::exists(folder / "2.program"));
    EXPECT_FALSE(fs::exists(folder / "1.program"));
    for (const char* other : {"not_ours.bin", "film.partial", "notes.program.old"})
        EXPECT_TRUE(fs::exists(folder / other)) << other;
    EXPECT_TRUE(fs::exists(folder / (unfinished + "0")));
    EXPECT_FALSE(fs::exists(folder / (unfinished + "2")));
    EXPECT_EQ(folder.files().size(), 6u) << "nothing unfinished is left";
}

TEST(Cache, ServesNoProgramOfAnotherKey) {
    const TempFolder folder;
    const std::vector<unsigned char> binary(10, 'x');
    write_program(folder / "a.program", "kernel void a() {}", binary);
    EXPECT_EQ(read_program(folder / "a.program", "kernel void a() {}"), binary);
    for (const char* other : {"kernel void b() {}", "kernel void a() {}x", "kernel void a() {", ""})
        EXPECT_TRUE(read_program(folder / "a.program", other).empty()) << other;
}

TEST(Cache, ServesNoDamagedProgram) {
    const TempFolder folder;
    write_program(folder / "a.program", "key", {1, 2, 3});
    fs::resize_file(folder / "a.program", fs::file_size(folder / "a.program") - 1);
    EXPECT_TRUE(read_program(folder / "a.program", "key").empty());
}

}  // namespace
}  // namespace wrinkle
