#pragma once

#include <nanobind/nanobind.h>

#include <exception>
#include <functional>
#include <optional>

#include "wrinkle/error.h"

namespace wrinkle::python {

/// Calls a Python function with the share of the work that is done, from work that runs without the interpreter's lock.
/// What it raises, and Ctrl-C, end the work: the library is told by an Error, Python gets its own exception.
class Progress {
public:
    explicit Progress(std::optional<nanobind::callable> call) : call_(std::move(call)) {}

    void operator()(double share) {
        nanobind::gil_scoped_acquire lock;
        try {
            if (PyErr_CheckSignals() != 0) throw nanobind::python_error();
            if (call_) (*call_)(share);
        } catch (nanobind::python_error&) {
            raised_ = std::current_exception();
            throw Error("stopped");
        }
    }

    /// Runs `work` without the interpreter's lock.
    template <class Work>
    auto around(const Work& work) {
        try {
            nanobind::gil_scoped_release unlocked;
            return work();
        } catch (const Error&) {
            if (raised_) std::rethrow_exception(raised_);
            throw;
        }
    }

private:
    std::optional<nanobind::callable> call_;
    std::exception_ptr raised_;
};

}  // namespace wrinkle::python
