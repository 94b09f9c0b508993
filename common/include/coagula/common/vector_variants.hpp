// SPDX-License-Identifier: GPL-3.0-or-later
// Kernels that are compiled for several kinds of processor, of which the program takes the best at its start.
#pragma once

// COAGULA_VARIANTS before a function, COAGULA_INLINE before what it calls, or the variants would not reach that. Sources that use
// them are compiled without fused multiply-add, so that every variant gives the same bits.
#if defined(__x86_64__) && defined(__GNUC__)
#define COAGULA_VARIANTS __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#define COAGULA_INLINE inline __attribute__((always_inline))
#else
#define COAGULA_VARIANTS
#define COAGULA_INLINE inline
#endif
