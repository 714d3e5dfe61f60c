#include "io/volume_child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <vector>

#include "base/atomic_file.h"
#include "base/claim.h"
#include "base/confined_process.h"
#include "base/limits.h"
#include "base/sanitizers.h"
#include "io/grid_bytes.h"
#include "wrinkle/error.h"

namespace wrinkle::io {
namespace {

// What a file may cost: packed voxels become at most some hundred times larger, and are copied twice. A sound file
// takes a hundredth of this time.
constexpr double kMemoryOfAny = 1.5e9, kMemoryPerByte = 300, kBytesPerSecond = 2e6;
constexpr int kSecondsOfAny = 2;

enum Argument { kProgram, kMode, kInput, kOutput, kSeconds, kMemory, kVoxels, kFile, kGrid, kArguments };

/// Shared memory that grows as it is written to.
class SharedMemory {
public:
    SharedMemory() : descriptor_(::memfd_create("wrinkle-volume", MFD_CLOEXEC)) {
        if (descriptor_ < 0) throw Error(fmt::format("no shared memory: {}", std::strerror(errno)));
    }
    ~SharedMemory() {
        if (mapped_ != MAP_FAILED) ::munmap(mapped_, size_);
        ::close(descriptor_);
    }
    SharedMemory(const SharedMemory&) = delete;
    SharedMemory& operator=(const SharedMemory&) = delete;

    int descriptor() const { return descriptor_; }

    /// What has been written.
    std::span<const std::byte> bytes() {
        const off_t size = ::lseek(descriptor_, 0, SEEK_END);
        if (size <= 0) return {};
        size_ = static_cast<std::size_t>(size);
        mapped_ = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, descriptor_, 0);
        if (mapped_ == MAP_FAILED) throw Error(fmt::format("no shared memory: {}", std::strerror(errno)));
        return {static_cast<const std::byte*>(mapped_), size_};
    }

private:
    int descriptor_;
    void* mapped_ = MAP_FAILED;
    std::size_t size_ = 0;
};

/// Starts the program and waits for it. Gives what waitpid() says; 0 when another part of the program has taken that.
int run_program(std::vector<std::string> words, std::span<const int> inherited) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int descriptor : inherited) posix_spawn_file_actions_adddup2(&actions, descriptor, descriptor);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    pid_t child = 0;
    const int failed =
        posix_spawn(&child, limits().volume_reader.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0)
        throw Error(fmt::format("{}: cannot be started to read volumes: {}", limits().volume_reader.string(),
                                std::strerror(failed)));
    int status = 0;
    while (::waitpid(child, &status, 0) < 0)
        if (errno != EINTR) return 0;
    return status;
}

template <class T>
T number(const char* text) {
    T value{};
    std::from_chars(text, text + std::strlen(text), value);
    return value;
}

/// Limits this process, so that a damaged file cannot take the machine's memory, run for ever, or reach anything else.
void limit_this_process(std::uint64_t seconds, std::uint64_t memory) {
    const auto limit = [](auto resource, rlim_t most) {
        rlimit now{};
        ::getrlimit(resource, &now);
        now.rlim_cur = std::min<rlim_t>(now.rlim_max, most);
        ::setrlimit(resource, &now);
    };
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, seconds);
    limit(RLIMIT_FSIZE, memory);
    if constexpr (!kAddressSanitizer) limit(RLIMIT_AS, memory);  // it reserves all of the address space
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    confine_process();
}

std::string read_and_pack(char** argv) {
    const InputFile file(number<int>(argv[kInput]), argv[kFile]);
    try {
        auto [raw, name] = read_grid(file, argv[kGrid], number<int>(argv[kVoxels]) != 0);
        return pack_grid(raw, name);
    } catch (const Error& error) { return pack_failure(error.what()); } catch (const std::bad_alloc&) {
        return pack_failure(file.name() + ": cannot be read: out of memory");
    }
}

}  // namespace

int serve_volume(int argc, char** argv) {
    if (argc != kArguments) return 2;
    limit_this_process(number<std::uint64_t>(argv[kSeconds]), number<std::uint64_t>(argv[kMemory]));
    return write_all(number<int>(argv[kOutput]), read_and_pack(argv)) == 0 ? 0 : 1;
}

std::pair<RawVolume, std::string> read_grid_in_child(const InputFile& file, const std::string& wanted, bool voxels) {
    const auto size = static_cast<double>(file.size());
    const double memory = std::min(memory_limit().bytes, kMemoryOfAny + kMemoryPerByte * size);
    const int seconds = kSecondsOfAny + static_cast<int>(size / kBytesPerSecond);
    SharedMemory shared;
    const int status = run_program(
        {"wrinkle", kServeVolume, fmt::format("{}", file.descriptor()), fmt::format("{}", shared.descriptor()),
         fmt::format("{}", seconds), fmt::format("{:.0f}", memory), voxels ? "1" : "0", file.name(), wanted},
        std::array{file.descriptor(), shared.descriptor()});
    const auto fail = [&](const std::string& why) {
        return Error(fmt::format("{}: cannot be read: {}; it may be truncated or damaged", file.name(), why));
    };
    if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL))
        throw fail(fmt::format("OpenVDB was stopped after {} s, or by the system", seconds));
    if (WIFSIGNALED(status)) throw fail(fmt::format("OpenVDB crashed over it (signal {})", WTERMSIG(status)));
    if (status != 0) throw fail(fmt::format("OpenVDB did not finish within {} of memory", bytes_text(memory)));
    return unpack_grid(shared.bytes(), file.name());
}

}  // namespace wrinkle::io
