#include "base/input_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "tests/io/files.h"

namespace wrinkle {
namespace {

constexpr std::size_t kBytes = std::size_t{4} << 20;

/// The share of the file that the system holds in memory.
double share_in_memory(const InputFile& file) {
    void* const at = ::mmap(nullptr, kBytes, PROT_READ, MAP_SHARED, file.descriptor(), 0);
    std::vector<unsigned char> pages(kBytes / static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)));
    EXPECT_EQ(::mincore(at, kBytes, pages.data()), 0);
    ::munmap(at, kBytes);
    return static_cast<double>(std::ranges::count_if(pages, [](unsigned char page) { return (page & 1) != 0; })) /
           static_cast<double>(pages.size());
}

TEST(InputFile, IsFetchedBeforeItIsRead) {
    const test::TempFolder folder;
    test::write_text(folder / "frame.exr", std::string(kBytes, 'x'));
    const InputFile file(folder / "frame.exr");
    ::fsync(file.descriptor());
    ::posix_fadvise(file.descriptor(), 0, 0, POSIX_FADV_DONTNEED);
    if (share_in_memory(file) > 0) GTEST_SKIP() << "the folder of temporary files is in memory itself";
    file.read_ahead();
    for (int i = 0; i < 500 && share_in_memory(file) < 1; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(share_in_memory(file), 1);
}

}  // namespace
}  // namespace wrinkle
