#include "cli/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>

#include "base/limits.h"
#include "base/temporary_name.h"
#include "device/program_cache.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {
namespace {

namespace fs = std::filesystem;

/// A file that is opened next would take the number of a stream that is closed, and get its messages.
void open_closed_streams() {
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (::fcntl(stream, F_GETFD) < 0) {
            const int opened = ::open("/dev/null", O_RDWR);
            if (opened >= 0 && opened != stream) ::dup2(opened, stream), ::close(opened);
        }
}

/// Where an exception has nowhere to go, such as in a thread of a library's.
[[noreturn]] void give_up() {
    const char* why = "a library gave up";
    try {
        if (std::current_exception()) std::rethrow_exception(std::current_exception());
    } catch (const std::bad_alloc&) { why = "out of memory"; } catch (const std::exception& error) {
        tell(std::string("stopped: ") + error.what());
        ::_exit(1);
    } catch (...) {}
    tell(why);
    ::_exit(1);
}

/// abort() of a library: LLVM's when it has no memory, or does not find what it needs.
void on_abort(int) {
    constexpr char text[] = "wrinkle: stopped by a library (out of memory, or it is not installed whole)\n";
    if (::write(STDERR_FILENO, text, sizeof text - 1) < 0) ::_exit(1);
    ::_exit(1);
}

bool is_writable(const fs::path& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    return !failed && ::access(folder.c_str(), W_OK | X_OK) == 0;
}

/// PoCL finds no device where it cannot write its cache, which it keeps in the home folder. It gets a place in ours,
/// or, where that cannot be written either, one for this run alone.
void place_pocl_cache() {
    if (std::getenv("POCL_CACHE_DIR") != nullptr) return;
    const fs::path ours = cache_folder();
    if (!ours.empty() && is_writable(ours / "pocl")) {
        ::setenv("POCL_CACHE_DIR", (ours / "pocl").c_str(), 1);
        return;
    }
    static std::string own = (fs::temp_directory_path() / "wrinkle-XXXXXX").string();
    if (::mkdtemp(own.data()) == nullptr) return;
    ::setenv("POCL_CACHE_DIR", own.c_str(), 1);
    std::atexit([] {
        std::error_code ignored;
        fs::remove_all(own, ignored);
    });
}

/// PoCL calls the linker "ld" by its name. It is looked for where systems have it as well.
void find_linker() {
    const char* const set = std::getenv("PATH");
    std::string path = set != nullptr ? set : "";
    for (const char* folder : {"/usr/bin", "/usr/local/bin", "/bin"}) {
        if ((":" + path + ":").find(fmt::format(":{}:", folder)) != std::string::npos) continue;
        if (::access((fs::path(folder) / "ld").c_str(), X_OK) == 0)
            path += (path.empty() ? "" : ":") + std::string(folder);
    }
    ::setenv("PATH", path.c_str(), 1);
}

/// Reaching the limit of a file's size then is an error of write(), like a full disk. To ignore the signal is not
/// enough: the compiler in Intel's OpenCL handles it, to say that it crashed. Threads begin with this one's mask.
void hold_back_file_size_signal() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGXFSZ);
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

/// Some libraries start threads while they are loaded, before main(), and end the program where there is no memory for
/// them. What stands in this section of a program runs before that.
void before_libraries(int, char**, char**) {
    std::signal(SIGABRT, on_abort);
    std::set_terminate(give_up);
}
[[gnu::section(".preinit_array"), gnu::used]] void (*const first)(int, char**, char**) = before_libraries;

struct LimitArguments {
    std::optional<double> gigabytes;
    fs::path sandbox;
};

}  // namespace

void tell(const std::string& text) noexcept {
    std::fputs("wrinkle: ", stderr);
    std::fputs(text.c_str(), stderr);
    std::fputs("\n", stderr);
}

void prepare_process() {
    open_closed_streams();
    hold_back_file_size_signal();
    std::signal(SIGPIPE, SIG_IGN);  // a reader that has gone is an error of write()
    remove_temporaries_on_signals();
    place_pocl_cache();
    find_linker();
}

void add_limit_options(CLI::App& app) {
    auto arguments = std::make_shared<LimitArguments>();
    app.add_option("--memory", arguments->gigabytes,
                   "gigabytes that it may take; what needs more is refused before (also: WRINKLE_MEMORY)")
        ->type_name("GB")
        ->check(CLI::PositiveNumber);
    app.add_option("--sandbox", arguments->sandbox,
                   "reads nothing outside of this folder, and runs no kernel of a scene's: for scenes of others")
        ->type_name("DIR");
    app.parse_complete_callback([arguments] {
        constexpr double kGigabyte = 1e9;
        set_limits({.memory = static_cast<std::uint64_t>(arguments->gigabytes.value_or(0) * kGigabyte),
                    .sandbox = arguments->sandbox,
                    .volume_reader = "/proc/self/exe"});
        memory_limit();  // says now what is wrong with WRINKLE_MEMORY
    });
    // These options may also follow the name of a command, except of `bench`, which hands all its arguments on.
    for (CLI::App* command : app.get_subcommands({}))
        if (!command->get_prefix_command()) command->fallthrough();
}

}  // namespace wrinkle::cli
