// SPDX-License-Identifier: GPL-3.0-or-later
// The kernels of OpenBLAS on processors that are newer than it.
#pragma once

namespace coagula {

/// OpenBLAS takes its oldest kernels on a processor that it does not know, although newer ones would run there twice as fast. Where
/// it has done so, this takes those of the closest processor that it knows. Whoever sets OPENBLAS_CORETYPE keeps what it names. No
/// other thread may be in a BLAS function meanwhile. The last digits of results depend on the kernels. Returns whether other
/// kernels were taken.
bool take_newest_blas_kernels();

}  // namespace coagula
