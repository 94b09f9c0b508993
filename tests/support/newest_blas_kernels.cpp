// SPDX-License-Identifier: GPL-3.0-or-later
// Test programs take the kernels that the program takes.
#include <coagula/common/blas_kernels.hpp>

namespace {

[[maybe_unused]] const bool newest_blas_kernels = coagula::take_newest_blas_kernels();

}  // namespace
