// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/parallel.hpp>

#include <omp.h>
#include <sys/mman.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <latch>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace coagula {

namespace {

/// Address space that the libraries take for a thread: a buffer of OpenBLAS (128 MB) and an arena of malloc (64 MB).
constexpr std::size_t thread_memory = std::size_t{192} << 20;

/// Reserves it, without using it.
class Reserved {
public:
    Reserved() : place_(mmap(nullptr, thread_memory, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0)) {}
    Reserved(const Reserved&) = delete;
    Reserved& operator=(const Reserved&) = delete;
    Reserved(Reserved&& other) noexcept : place_(std::exchange(other.place_, MAP_FAILED)) {}
    Reserved& operator=(Reserved&&) = delete;
    ~Reserved() {
        if (*this) {
            munmap(place_, thread_memory);
        }
    }
    explicit operator bool() const { return place_ != MAP_FAILED; }

private:
    void* place_;
};

}  // namespace

void run_together(std::size_t count, const std::function<void(std::size_t)>& work, std::size_t at_once) {
    const std::size_t threads =
        std::max<std::size_t>(1, std::min({count, at_once, static_cast<std::size_t>(omp_get_max_threads())}));
    std::exception_ptr failure;  // an exception must not leave a parallel loop
    std::atomic<bool> failed = false;
#pragma omp parallel for schedule(dynamic) num_threads(static_cast <int>(threads)) if (threads > 1)
    for (std::size_t k = 0; k < count; ++k) {
        if (failed) {
            continue;
        }
        try {
            work(k);
        } catch (...) {
            if (!failed.exchange(true)) {
                failure = std::current_exception();
            }
        }
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

int threads_within_limits(int wanted) {
    std::vector<Reserved> memory(1);
    if (!memory.front()) {
        return 0;
    }
    std::latch all_tried(1);
    std::vector<std::thread> threads;
    for (int k = 1; k < wanted; ++k) {
        memory.emplace_back();
        if (!memory.back()) {
            break;
        }
        try {
            threads.emplace_back([&] { all_tried.wait(); });
        } catch (const std::system_error&) {
            break;
        }
    }
    all_tried.count_down();
    for (std::thread& thread : threads) {
        thread.join();
    }
    return static_cast<int>(threads.size()) + 1;
}

int usable_threads(int wanted) {
    return std::max(1, threads_within_limits(std::min({wanted, omp_get_num_procs(), omp_get_thread_limit()})));
}

}  // namespace coagula
