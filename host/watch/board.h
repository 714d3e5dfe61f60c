#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "look/look.h"

namespace wrinkle {

class [[gnu::visibility("hidden")]] WatchSession;  // as hidden as the passes that it holds

/// All that the thread which evaluates and those of the server share, behind one mutex: what is shown, and what is
/// asked for.
class [[gnu::visibility("hidden")]] WatchBoard {
public:
    struct Shown {
        std::uint64_t version = 0;  ///< 0: nothing yet
        std::string state;          ///< JSON for the page
        std::shared_ptr<const LookImage> image;
    };
    using Task = std::function<std::string(WatchSession&)>;

    /// What is shown; waits until that is newer than `version`, it stops, or the time is over.
    Shown shown(std::uint64_t version, std::chrono::milliseconds most) const;
    Shown shown() const { return shown(0, {}); }

    /// Has the evaluating thread do something, and waits for its answer. Throws what that throws, and Error once it
    /// stops.
    std::string ask(Task task);

    /// For the evaluating thread: what is shown from now on, and the next thing to do, or nothing when the time is
    /// over.
    void show(Shown shown);
    std::optional<std::packaged_task<std::string(WatchSession&)>> next(std::chrono::milliseconds most);

    void stop();
    bool is_stopped() const;

private:
    mutable std::mutex mutex_;
    mutable std::condition_variable changed_;
    Shown shown_;
    std::deque<std::packaged_task<std::string(WatchSession&)>> tasks_;
    bool stopped_ = false;
};

}  // namespace wrinkle
