// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/blas_kernels.hpp>

#include <cstdlib>
#include <string_view>

extern "C" {
// Only OpenBLAS that chooses kernels while it runs has these functions. With another BLAS they are null.
char* openblas_get_corename() __attribute__((weak));  // NOLINT(readability-identifier-naming)
void gotoblas_dynamic_init() __attribute__((weak));   // NOLINT(readability-identifier-naming)
void gotoblas_dynamic_quit() __attribute__((weak));   // NOLINT(readability-identifier-naming)
}

namespace coagula {

namespace {

constexpr const char* variable = "OPENBLAS_CORETYPE";  // OpenBLAS reads it whenever it chooses its kernels

/// The newest kernels of OpenBLAS that this processor can run, or null where it can run the oldest only.
const char* kernels_of_this_processor() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd")) {
        return "SkylakeX";
    }
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        return "Haswell";
    }
#endif
    return nullptr;
}

/// Whether OpenBLAS took the kernels that it takes on a processor unknown to it.
bool fell_back() {
    return openblas_get_corename != nullptr && std::string_view(openblas_get_corename()) == "Prescott";
}

}  // namespace

bool take_newest_blas_kernels() {
    const char* kernels = kernels_of_this_processor();
    if (kernels == nullptr || std::getenv(variable) != nullptr || gotoblas_dynamic_init == nullptr ||
        gotoblas_dynamic_quit == nullptr || !fell_back()) {
        return false;
    }
    setenv(variable, kernels, 1);
    gotoblas_dynamic_quit();
    gotoblas_dynamic_init();
    unsetenv(variable);  // programs that this one starts may run on other processors
    return true;
}

}  // namespace coagula
