#include "cli/check_child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <nlohmann/json.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "base/atomic_file.h"
#include "cli/json_text.h"
#include "cli/options.h"
#include "selftest/checks.h"
#include "wrinkle/error.h"

namespace wrinkle::cli {

namespace {

using nlohmann::json;

/// What a report of a defect should say of a device.
json description(const Device& device) {
    const cl::Device& d = device.device;
    const auto size = [](std::size_t n) { return static_cast<std::uint64_t>(n); };
    return {{"name", device.info.name},
            {"platform", device.info.platform},
            {"platform_version", cl::Platform(d.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_VERSION>()},
            {"type", device.info.type},
            {"version", device.info.version},
            {"driver", device.info.driver},
            {"language", d.getInfo<CL_DEVICE_OPENCL_C_VERSION>()},
            {"compute_units", device.info.compute_units},
            {"memory_bytes", device.info.memory},
            {"largest_allocation_bytes", size(d.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>())},
            {"largest_group", size(d.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>())},
            {"own_memory", device.info.own_memory},
            {"denormals", (d.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_DENORM) != 0},
            {"lanes", device.info.lanes},
            {"fp64", device.info.fp64}};
}

json findings_of(const std::vector<selftest::Finding>& findings) {
    json list = json::array();
    for (const selftest::Finding& f : findings)  // null: not finite
        list.push_back(
            {{"what", f.what}, {"unit", f.unit}, {"error", f.error}, {"bound", f.bound}, {"good", f.good()}});
    return list;
}

}  // namespace

void serve_device_check(const WantedCheck& wanted, std::size_t first, int descriptor) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody would read on
    const rlimit no_core{};
    ::setrlimit(RLIMIT_CORE, &no_core);
    const auto say = [&](const json& line) {
        if (write_all(descriptor, json_text(line, -1) + '\n') != 0) throw Error("nobody waits for what is checked");
    };
    std::vector<selftest::Check> checks = selftest::all_checks();
    std::erase_if(checks, [&](const auto& check) { return check.name.find(wanted.only) == std::string::npos; });
    std::optional<Device> opened;
    try {
        if (checks.empty()) throw Error(fmt::format("no check has \"{}\" in its name", wanted.only));
        opened = open_device(wanted.device, wanted.lanes);
    } catch (const Error& error) { return say({{"refused", error.what()}}); }
    const Device& device = *opened;
    say({{"device", description(device)}});
    for (std::size_t i = first; i < checks.size(); ++i) {
        say({{"begins", checks[i].name}, {"number", i}, {"of", checks.size()}, {"may_take", checks[i].seconds}});
        const auto began = CheckChild::Clock::now();
        json told;
        try {
            told["findings"] = findings_of(checks[i].run(device));
        } catch (const Error& error) { told["failed"] = error.what(); }
        told["seconds"] = std::chrono::duration<double>(CheckChild::Clock::now() - began).count();
        say(told);
    }
}

CheckChild::CheckChild(const WantedCheck& wanted, std::size_t first) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw Error(fmt::format("no pipe: {}", std::strerror(errno)));
    pipe_ = ends[0];
    std::vector<std::string> words{
        "wrinkle", "devices", "--check-on", fmt::format("{}", ends[1]), "--check-from", fmt::format("{}", first)};
    if (wanted.lanes != 0) words.insert(words.end(), {"--lanes", fmt::format("{}", wanted.lanes)});
    if (!wanted.device.empty()) words.insert(words.end(), {"--device", wanted.device});
    if (!wanted.only.empty()) words.insert(words.end(), {"--only", wanted.only});
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], ends[1]);
    // Drivers print what they like.
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
    const int failed = posix_spawn(&process_, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (failed == 0) return;
    ::close(pipe_);
    throw Error(fmt::format("wrinkle cannot start itself to check a device: {}", std::strerror(failed)));
}

CheckChild::~CheckChild() {
    if (process_ > 0) ::kill(process_, SIGKILL), fate();
    ::close(pipe_);
}

CheckChild::Said CheckChild::next(std::string& line, Clock::time_point until) {
    for (;;) {
        if (const auto end = read_.find('\n'); end != std::string::npos) {
            line = read_.substr(0, end), read_.erase(0, end + 1);
            return Said::line;
        }
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
        pollfd wanted{pipe_, POLLIN, 0};
        const int ready = left <= 0 ? 0 : ::poll(&wanted, 1, static_cast<int>(std::min<long long>(left, 1000000)));
        if (ready < 0 && errno == EINTR) continue;
        if (ready <= 0) return Said::nothing;
        std::array<char, 65536> bytes;
        const ssize_t count = ::read(pipe_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return Said::end;
        read_.append(bytes.data(), static_cast<std::size_t>(count));
    }
}

std::optional<std::string> CheckChild::fate() {
    int status = 0;
    // A process that is stuck in a driver's system call cannot be killed, and is left alone.
    const auto until = Clock::now() + std::chrono::seconds(5);
    const pid_t process = std::exchange(process_, -1);
    for (pid_t ended = 0; ended != process;) {
        ended = ::waitpid(process, &status, WNOHANG);
        if (ended < 0 && errno != EINTR) break;
        if (ended == 0 && Clock::now() >= until) return "cannot be ended";
        if (ended <= 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (WIFSIGNALED(status)) return fmt::format("crashed (signal {})", WTERMSIG(status));
    if (WEXITSTATUS(status) != 0) return fmt::format("ended the program (status {})", WEXITSTATUS(status));
    return std::nullopt;
}

}  // namespace wrinkle::cli
