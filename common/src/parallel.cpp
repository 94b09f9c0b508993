#include <coagula/common/parallel.hpp>

#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>

namespace coagula {

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

}  // namespace coagula
