#include "base/confined_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <string>

namespace wrinkle {
namespace {

bool is_refused(int result) { return result < 0 && errno == EPERM; }

/// The first call that did not do as it should, as the exit status of a child; 0: none; 99: it cannot be confined here.
int wrong_call(const std::string& file) {
    const int open_before = ::open(file.c_str(), O_RDWR);
    if (!confine_process()) return 99;
    if (!is_refused(::socket(AF_UNIX, SOCK_STREAM, 0))) return 1;
    if (!is_refused(::execl("/bin/true", "true", nullptr))) return 2;
    if (!is_refused(::open(file.c_str(), O_RDWR))) return 3;
    if (!is_refused(::open((file + "2").c_str(), O_CREAT | O_WRONLY, 0600))) return 4;
    if (!is_refused(::unlink(file.c_str()))) return 5;
    if (!is_refused(::rename(file.c_str(), (file + "3").c_str()))) return 6;
    char byte = 0;
    const int reads = ::open(file.c_str(), O_RDONLY);
    if (reads < 0 || ::read(reads, &byte, 1) != 1 || byte != 'a') return 7;
    return ::write(open_before, "b", 1) == 1 ? 0 : 8;
}

TEST(ConfinedProcess, ReadsAndWritesWhatIsOpenOnly) {
    const std::string file =
        std::filesystem::temp_directory_path() / ("wrinkle_confined_" + std::to_string(::getpid()));
    std::ofstream(file) << "a";
    const pid_t child = ::fork();
    if (child == 0) ::_exit(wrong_call(file));
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    std::filesystem::remove(file);
    ASSERT_TRUE(WIFEXITED(status)) << WTERMSIG(status);
    if (WEXITSTATUS(status) == 99) GTEST_SKIP() << "no seccomp here";
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace wrinkle
