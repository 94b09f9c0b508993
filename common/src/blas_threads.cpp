#include <coagula/common/blas_threads.hpp>

extern "C" {
// Only OpenBLAS has these; null with another BLAS.
void openblas_set_num_threads(int) __attribute__((weak));  // NOLINT(readability-identifier-naming)
int openblas_get_num_threads() __attribute__((weak));      // NOLINT(readability-identifier-naming)
}

namespace coagula {

BlasThreads::BlasThreads(int threads) {
    if (openblas_set_num_threads != nullptr && openblas_get_num_threads != nullptr) {
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
