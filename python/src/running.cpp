// SPDX-License-Identifier: GPL-3.0-or-later
#include "running.hpp"

#include <coagula/common/parallel.hpp>

#include <omp.h>
#include <pthread.h>

namespace coagula::python {

bool Reporter::is_due(std::string_view stage) {
    const std::scoped_lock lock(mutex_);
    const auto now = Clock::now();
    if (stage == stage_ && now - last_ < std::chrono::milliseconds(50)) {
        return false;
    }
    last_ = now;
    stage_ = stage;
    return true;
}

bool Reporter::tell(std::string_view stage, double fraction, std::string_view remark) {
    {
        const std::scoped_lock lock(mutex_);
        if (raised_) {
            return false;
        }
    }
    if (!is_due(stage)) {
        return true;
    }
    const py::gil_scoped_acquire acquired;
    try {
        if (PyErr_CheckSignals() != 0) {
            throw py::error_already_set();
        }
        if (!callback_.is_none()) {
            callback_(py::str(stage.data(), stage.size()), fraction, py::str(remark.data(), remark.size()));
        }
        return true;
    } catch (const py::error_already_set&) {
        const std::scoped_lock lock(mutex_);
        raised_ = raised_ ? raised_ : std::current_exception();
        return false;
    }
}

void Reporter::rethrow() const {
    if (raised_) {
        std::rethrow_exception(raised_);
    }
}

ThreadCount::ThreadCount(std::optional<int> count) : before_(omp_get_max_threads()) {
    omp_set_num_threads(usable_threads(count.value_or(before_)));
}

ThreadCount::~ThreadCount() {
    omp_set_num_threads(before_);
}

void prepare_for_forks() {
    pthread_atfork([] { omp_pause_resource_all(omp_pause_hard); }, nullptr, nullptr);
}

}  // namespace coagula::python
