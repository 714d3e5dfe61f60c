#include "run/band_pipeline.h"

#include <array>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

namespace wrinkle {

namespace {

/// How far each stage is, and the first error.
class Progress {
public:
    Progress(std::uint32_t bands, std::uint32_t in_flight) : bands_(bands), in_flight_(in_flight) {}

    /// One stage of all bands, each as soon as it may begin.
    void work(std::size_t stage, const std::function<void(std::uint32_t)>& step) {
        try {
            for (std::uint32_t band = 0; band < bands_ && wait(stage, band); ++band) {
                step(band);
                const std::lock_guard lock(mutex_);
                ++done_[stage];
                changed_.notify_all();
            }
        } catch (...) {
            const std::lock_guard lock(mutex_);
            if (!failure_) failure_ = std::current_exception();
            changed_.notify_all();
        }
    }

    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }

private:
    /// False once a stage has failed.
    bool wait(std::size_t stage, std::uint32_t band) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] {
            return failure_ || (stage == 0 ? band < done_.back() + in_flight_ : band < done_[stage - 1]);
        });
        return !failure_;
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::uint32_t bands_, in_flight_;
    std::array<std::uint32_t, 3> done_{};
    std::exception_ptr failure_;
};

}  // namespace

void run_bands(std::uint32_t bands, std::uint32_t in_flight, const BandStages& stages) {
    Progress progress(bands, in_flight);
    {
        const std::jthread reading([&] { progress.work(0, stages.read); });
        const std::jthread writing([&] { progress.work(2, stages.write); });
        progress.work(1, stages.evaluate);
    }
    progress.rethrow();
}

}  // namespace wrinkle
