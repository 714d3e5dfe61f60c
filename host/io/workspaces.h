#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace wrinkle::io {

/// Memory that threads work in, kept for the next one: touching fresh memory costs as much as the work.
template <class Workspace>
class Workspaces {
public:
    std::unique_ptr<Workspace> borrow() {
        const std::lock_guard lock(mutex_);
        if (idle_.empty()) return std::make_unique<Workspace>();
        auto workspace = std::move(idle_.back());
        idle_.pop_back();
        return workspace;
    }

    void give_back(std::unique_ptr<Workspace> workspace) {
        const std::lock_guard lock(mutex_);
        idle_.push_back(std::move(workspace));
    }

private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Workspace>> idle_;
};

}  // namespace wrinkle::io
