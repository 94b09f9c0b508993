// SPDX-License-Identifier: GPL-3.0-or-later
// Long work without the lock of the interpreter: progress, interruption, number of threads.
#pragma once

#include <coagula/common/progress.hpp>

#include <pybind11/pybind11.h>

#include <chrono>
#include <exception>
#include <mutex>
#include <optional>
#include <string>

namespace coagula::python {

namespace py = pybind11;

/// Tells a Python callable how far the work has come, and looks for signals (Ctrl-C). What they raise stops the work.
class Reporter {
public:
    /// @param callback called as callback(stage, fraction, remark); None: nobody is told.
    explicit Reporter(py::object callback) : callback_(std::move(callback)) {}

    /// To be called without the lock of the interpreter, from any thread; at most twenty calls a second and one for each new stage
    /// go through. False: stop.
    bool tell(std::string_view stage, double fraction, std::string_view remark);

    /// Throws what Python raised in the meantime, if it did.
    void rethrow() const;

private:
    using Clock = std::chrono::steady_clock;

    bool is_due(std::string_view stage);

    py::object callback_;
    std::mutex mutex_;  ///< of the members below; never held while waiting for the interpreter
    Clock::time_point last_ = Clock::now();
    std::string stage_;
    std::exception_ptr raised_;
};

/// The number of threads of the calls in its life.
class ThreadCount {
public:
    explicit ThreadCount(std::optional<int> count);
    ThreadCount(const ThreadCount&) = delete;
    ThreadCount& operator=(const ThreadCount&) = delete;
    ~ThreadCount();

private:
    int before_;
};

/// A forked child has none of the threads of OpenMP and would wait for them for ever. With this they end before every fork, and
/// both processes start new ones when they need them.
void prepare_for_forks();

/// Calls work(progress) without the lock of the interpreter.
template <class Work>
auto run(const py::object& callback, std::optional<int> threads, const Work& work) {
    Reporter reporter(callback);
    const ThreadCount count(threads);
    try {
        const py::gil_scoped_release released;
        return work(Progress([&](std::string_view stage, double fraction, std::string_view remark) {
            return reporter.tell(stage, fraction, remark);
        }));
    } catch (...) {
        reporter.rethrow();
        throw;
    }
}

}  // namespace coagula::python
