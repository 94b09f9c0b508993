// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coagula/common/dem/kernels.hpp>

namespace coagula::dem::detail {

/// For processors with AVX2; exists where COAGULA_WIDE_KERNELS is defined.
extern const Kernels wide_kernels;

}  // namespace coagula::dem::detail
