// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/blas_kernels.hpp>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <cstdlib>
#include <string>

extern "C" {
char* openblas_get_corename() __attribute__((weak));  // NOLINT(readability-identifier-naming)
void gotoblas_dynamic_init() __attribute__((weak));   // NOLINT(readability-identifier-naming)
void gotoblas_dynamic_quit() __attribute__((weak));   // NOLINT(readability-identifier-naming)
void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*, const double*, const int*, const double*,
            const int*, const double*, double*, const int*);
}

namespace coagula {

namespace {

/// Lets OpenBLAS choose the oldest kernels, as on a processor that is newer than it.
void take_oldest() {
    setenv("OPENBLAS_CORETYPE", "Prescott", 1);
    gotoblas_dynamic_quit();
    gotoblas_dynamic_init();
    unsetenv("OPENBLAS_CORETYPE");
}

bool has_newer_kernels() {
#if defined(__x86_64__)
    return openblas_get_corename != nullptr && gotoblas_dynamic_quit != nullptr && __builtin_cpu_supports("avx2");
#else
    return false;
#endif
}

class BlasKernels : public ::testing::Test {
protected:
    void SetUp() override {
        if (!has_newer_kernels()) {
            GTEST_SKIP() << "the BLAS has one set of kernels, or this processor can run no other";
        }
        take_oldest();
        ASSERT_EQ(std::string(openblas_get_corename()), "Prescott");
    }
    void TearDown() override {
        unsetenv("OPENBLAS_CORETYPE");
        take_newest_blas_kernels();
    }
};

TEST_F(BlasKernels, TheNewestThatTheProcessorRunsTakeThePlaceOfTheOldest) {
    EXPECT_TRUE(take_newest_blas_kernels());
    const std::string taken = openblas_get_corename();
    EXPECT_TRUE(taken == "SkylakeX" || taken == "Haswell") << taken;
    EXPECT_EQ(std::getenv("OPENBLAS_CORETYPE"), nullptr);
    EXPECT_FALSE(take_newest_blas_kernels());  // they are taken already
}

TEST_F(BlasKernels, ThoseThatTheUserNamesStay) {
    setenv("OPENBLAS_CORETYPE", "Prescott", 1);
    EXPECT_FALSE(take_newest_blas_kernels());
    EXPECT_EQ(std::string(openblas_get_corename()), "Prescott");
}

TEST_F(BlasKernels, MultiplyAsTheOldestDo) {
    const int size = 301;
    const Eigen::MatrixXd left = Eigen::MatrixXd::Random(size, size);
    const Eigen::MatrixXd right = Eigen::MatrixXd::Random(size, size);
    const auto product = [&] {
        Eigen::MatrixXd found(size, size);
        const double one = 1;
        const double none = 0;
        dgemm_("N", "N", &size, &size, &size, &one, left.data(), &size, right.data(), &size, &none, found.data(), &size);
        return found;
    };
    const Eigen::MatrixXd before = product();
    ASSERT_TRUE(take_newest_blas_kernels());
    EXPECT_LT((product() - before).norm(), 1e-13 * before.norm());
    EXPECT_LT((before - left * right).norm(), 1e-13 * before.norm());
}

}  // namespace

}  // namespace coagula
