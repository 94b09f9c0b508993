// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <coagula/common/dem/kernels.hpp>

namespace coagula::dem::detail {

/// The kernels for processors with AVX2. They exist where COAGULA_WIDE_KERNELS is defined.
extern const Kernels wide_kernels;

}  // namespace coagula::dem::detail
