#include "watch/board.h"

#include "wrinkle/error.h"

namespace wrinkle {

WatchBoard::Shown WatchBoard::shown(std::uint64_t version, std::chrono::milliseconds most) const {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, most, [&] { return stopped_ || shown_.version > version; });
    return shown_;
}

std::string WatchBoard::ask(Task task) {
    std::future<std::string> answer;
    {
        const std::lock_guard lock(mutex_);
        if (stopped_) throw Error("wrinkle watch is ending");
        answer = tasks_.emplace_back(std::move(task)).get_future();
    }
    changed_.notify_all();
    try {
        return answer.get();
    } catch (const std::future_error&) { throw Error("wrinkle watch is ending"); }
}

void WatchBoard::show(Shown shown) {
    {
        const std::lock_guard lock(mutex_);
        shown_ = std::move(shown);
    }
    changed_.notify_all();
}

std::optional<std::packaged_task<std::string(WatchSession&)>> WatchBoard::next(std::chrono::milliseconds most) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, most, [&] { return stopped_ || !tasks_.empty(); });
    if (tasks_.empty()) return {};
    auto task = std::move(tasks_.front());
    tasks_.pop_front();
    return task;
}

void WatchBoard::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopped_ = true;
        tasks_.clear();  // who waits for one is told
    }
    changed_.notify_all();
}

bool WatchBoard::is_stopped() const {
    const std::lock_guard lock(mutex_);
    return stopped_;
}

}  // namespace wrinkle
