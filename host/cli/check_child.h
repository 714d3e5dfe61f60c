#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

/// The self-test runs in a process of its own: a driver that crashes over a kernel, or compiles it for ever, ends that
/// process, and the one that asked tells of it and goes on with the next check.
namespace wrinkle::cli {

/// What to check.
struct WantedCheck {
    std::string device;  ///< Device::open takes it
    int lanes = 0;       ///< 0: the device's own choice
    std::string only;    ///< part of the names of checks
    bool operator==(const WantedCheck&) const = default;
};

/// Does the checks from the one with this number on, and tells of it in lines of JSON on `descriptor`: first about the
/// device, then before and after each check.
void serve_device_check(const WantedCheck& wanted, std::size_t first, int descriptor);

/// Such a process, and its lines.
class CheckChild {
public:
    /// Throws Error where it cannot be started.
    CheckChild(const WantedCheck& wanted, std::size_t first);
    ~CheckChild();  ///< ends it
    CheckChild(const CheckChild&) = delete;
    CheckChild& operator=(const CheckChild&) = delete;

    using Clock = std::chrono::steady_clock;
    enum class Said { line, end, nothing };
    /// Waits for a line; `nothing`: none came until then.
    Said next(std::string& line, Clock::time_point until);

    /// Once it has come to its end: how, "crashed (signal 11)"; nothing where all is well.
    std::optional<std::string> fate();

private:
    int pipe_ = -1;
    pid_t process_ = -1;
    std::string read_;
};

}  // namespace wrinkle::cli
