#pragma once

#include <algorithm>
#include <chrono>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace wrinkle {

/// Measures the phases of a run that overlap: total time of each, and what of the wall time none of them covers.
class PhaseClock {
public:
    using Clock = std::chrono::steady_clock;
    enum Phase { read, textures, build, kernels, check, write, count };

    /// Runs `work` and counts its time to `phase`; from any thread.
    template <class Work>
    auto measure(Phase phase, Work work) {
        struct Scope {
            PhaseClock& clock;
            Phase phase;
            Clock::time_point start = Clock::now();
            ~Scope() { clock.add(phase, start, Clock::now()); }
        } scope{*this, phase};
        return work();
    }

    double seconds(Phase phase) const {
        double sum = 0;
        for (const Span& span : spans_)
            if (span.phase == phase) sum += between(span.start, span.end);
        return sum;
    }

    double wall() const { return between(start_, Clock::now()); }

    /// Wall time outside every measured phase of `phases`.
    double outside(std::initializer_list<Phase> phases) const {
        std::vector<std::pair<Clock::time_point, Clock::time_point>> covered;
        for (const Span& span : spans_)
            if (std::ranges::find(phases, span.phase) != phases.end()) covered.emplace_back(span.start, span.end);
        std::ranges::sort(covered);
        double sum = 0;
        Clock::time_point reached = start_;
        for (const auto& [start, end] : covered) {
            if (start > reached) sum += between(reached, start);
            reached = std::max(reached, end);
        }
        return sum + std::max(0.0, between(reached, Clock::now()));
    }

private:
    struct Span {
        Phase phase;
        Clock::time_point start, end;
    };

    static double between(Clock::time_point a, Clock::time_point b) {
        return std::chrono::duration<double>(b - a).count();
    }

    void add(Phase phase, Clock::time_point start, Clock::time_point end) {
        const std::lock_guard lock(mutex_);
        spans_.push_back({phase, start, end});
    }

    Clock::time_point start_ = Clock::now();
    std::mutex mutex_;
    std::vector<Span> spans_;
};

}  // namespace wrinkle
