#include "run/band_pipeline.h"

#include <array>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace wrinkle {

namespace {

/// How far the stages of a frame are.
class Progress {
public:
    Progress(std::uint32_t bands, std::uint32_t in_flight) : bands_(bands), in_flight_(in_flight) {}

    /// Brings every band through one stage, as soon as the stages before and after it allow, until one has failed.
    void go_through(std::size_t stage, const std::function<void(std::uint32_t band)>& work) noexcept {
        try {
            for (std::uint32_t band = 0; band < bands_ && may_begin(stage, band); ++band) {
                work(band);
                const std::lock_guard lock(mutex_);
                done_[stage] = band + 1;
                changed_.notify_all();
            }
        } catch (...) { fail(std::current_exception()); }
    }

    void fail(const std::exception_ptr& error) noexcept {
        const std::lock_guard lock(mutex_);
        if (error_ == nullptr) error_ = error;
        changed_.notify_all();
    }

    /// Throws what failed first. All stages have come to their ends.
    void check() const {
        if (error_ != nullptr) std::rethrow_exception(error_);
    }

private:
    bool may_begin(std::size_t stage, std::uint32_t band) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [&] {
            return error_ != nullptr || (stage == 0 ? band - done_.back() < in_flight_ : band < done_[stage - 1]);
        });
        return error_ == nullptr;
    }

    std::uint32_t bands_, in_flight_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::array<std::uint32_t, 3> done_{};  ///< bands that each stage has finished
    std::exception_ptr error_;
};

}  // namespace

void run_bands(std::uint32_t bands, std::uint32_t in_flight, const BandStages& stages) {
    bool threads = bands > 1;  // nothing runs beside a band that is the only one
    if (threads) {
        Progress progress(bands, in_flight);
        {
            std::jthread reader, writer;
            try {
                // The writer waits, so that nothing has begun where there is no thread for the reader.
                writer = std::jthread([&] { progress.go_through(2, stages.write); });
                reader = std::jthread([&] { progress.go_through(0, stages.read); });
                progress.go_through(1, stages.evaluate);
            } catch (const std::system_error&) {
                threads = false;
                progress.fail(std::current_exception());
            }
        }
        if (threads) progress.check();
    }
    for (std::uint32_t band = 0; band < bands && !threads; ++band)
        stages.read(band), stages.evaluate(band), stages.write(band);
}

}  // namespace wrinkle
