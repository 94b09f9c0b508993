// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/blas_threads.hpp>

#include <coagula/common/parallel.hpp>

#include <atomic>
#include <stdexcept>
#include <string>

extern "C" {
// Only OpenBLAS has these functions. With another BLAS they are null.
void openblas_set_num_threads(int) __attribute__((weak));  // NOLINT(readability-identifier-naming)
int openblas_get_num_threads() __attribute__((weak));      // NOLINT(readability-identifier-naming)
}

namespace coagula {

namespace {

/// OpenBLAS asks for the buffers of its threads over and over again where there is no room for them, and waits for ever for threads
/// that it did not get. What it has had once, it keeps.
void require_room_for(int threads) {
    static std::atomic<int> had = 0;
    if (threads <= had) {
        return;
    }
    if (threads_within_limits(threads) < threads) {
        throw std::runtime_error("there is not enough address space left for the linear algebra, or no further thread: " +
                                 std::to_string(threads) + " threads need 192 MB each; raise the limits (ulimit -v, ulimit -u)");
    }
    had = threads;
}

}  // namespace

BlasThreads::BlasThreads(int threads) {
    if (openblas_set_num_threads != nullptr && openblas_get_num_threads != nullptr) {
        require_room_for(threads);
        before_ = openblas_get_num_threads();
        openblas_set_num_threads(threads);
    }
}

BlasThreads::~BlasThreads() {
    if (before_ > 0) {
        openblas_set_num_threads(before_);
    }
}

}  // namespace coagula
