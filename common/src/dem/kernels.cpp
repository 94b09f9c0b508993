// SPDX-License-Identifier: GPL-3.0-or-later
#include <coagula/common/dem/kernels.hpp>

#include "wide_kernels.hpp"

namespace coagula::dem::detail {

const Kernels& plain_kernels() {
    static constexpr Kernels plain{add_bond_forces<OneLane, OneLane, SpringForce>, move_particles<OneLane>,
                                   find_touching<OneLane, OneLane>, find_near<OneLane, OneLane>};
    return plain;
}

const Kernels& fastest_kernels() {
#ifdef COAGULA_WIDE_KERNELS
    static const bool wide = __builtin_cpu_supports("avx2");
    return wide ? wide_kernels : plain_kernels();
#else
    return plain_kernels();
#endif
}

}  // namespace coagula::dem::detail
