#pragma once

#include <nanobind/nanobind.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <optional>

#include "wrinkle/error.h"

namespace wrinkle::python {

/// Calls a Python function with the share of the work that is done, from work that runs without the interpreter's lock.
/// What it raises, and Ctrl-C, end the work: the library is told by an Error, Python gets its own exception. The work
/// is on a thread of its own, as Python notices Ctrl-C on the calling one only.
class Progress {
public:
    explicit Progress(std::optional<nanobind::callable> call) : call_(std::move(call)) {}

    void operator()(double share) {
        if (!stopped_ && call_) {
            nanobind::gil_scoped_acquire lock;
            try {
                (*call_)(share);
            } catch (nanobind::python_error&) { stop(); }
        }
        if (stopped_) throw Error("stopped");
    }

    /// Runs `work` without the interpreter's lock.
    template <class Work>
    auto around(const Work& work) {
        nanobind::gil_scoped_release unlocked;
        auto done = std::async(std::launch::async, work);
        while (done.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
            nanobind::gil_scoped_acquire lock;
            if (stopped_ || PyErr_CheckSignals() == 0) continue;
            try {
                throw nanobind::python_error();
            } catch (nanobind::python_error&) { stop(); }
        }
        if (stopped_) {
            done.wait();
            std::rethrow_exception(raised_);
        }
        return done.get();
    }

private:
    /// Keeps the exception that is being handled; called with the interpreter's lock.
    void stop() {
        raised_ = std::current_exception();
        stopped_ = true;
    }

    std::optional<nanobind::callable> call_;
    std::exception_ptr raised_;
    std::atomic<bool> stopped_ = false;
};

}  // namespace wrinkle::python
