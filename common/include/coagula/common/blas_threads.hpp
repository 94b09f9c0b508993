// SPDX-License-Identifier: GPL-3.0-or-later
// How many threads the dense kernels below CHOLMOD use.
#pragma once

namespace coagula {

/// Sets the number of BLAS threads (OpenBLAS; no effect with another BLAS) and puts the old one back at the end of its life.
/// The bits of a factor depend on that number, so it is fixed by the kind of work and not by the user's number of threads.
class BlasThreads {
public:
    /// Throws std::runtime_error where the limits of the process leave no room for them.
    explicit BlasThreads(int threads);
    ~BlasThreads();
    BlasThreads(const BlasThreads&) = delete;
    BlasThreads& operator=(const BlasThreads&) = delete;

private:
    int before_ = 0;
};

}  // namespace coagula
