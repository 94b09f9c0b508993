// SPDX-License-Identifier: GPL-3.0-or-later
// The loops in which nearly all time of an explicit step of a bonded network is spent, for the widest instructions of the
// processor.
//
// The variant is chosen at run time. All give the same bits: every operation is rounded by itself (no fused multiply-add), and sums
// are formed in the same order.
#pragma once

#include <coagula/common/dem/bond_loop.hpp>
#include <coagula/common/dem/motion_loop.hpp>
#include <coagula/common/dem/pair_loop.hpp>

namespace coagula::dem::detail {

struct Kernels {
    /// Brings shear displacements up to date and adds forces and moments of `count` linear springs (BondedContact).
    BondExtremes (*add_spring_forces)(const SlotArrays& slots, BondBlock* blocks, std::size_t count, const SpringForce& force);
    /// move_particles() of motion_loop.hpp.
    double (*move_particles)(const MotionArrays& slots, std::size_t begin, std::size_t end, const MotionStep& step);
    /// find_touching() of pair_loop.hpp.
    std::size_t (*find_touching)(const double* position, const std::int32_t* ends, std::size_t count, double gap,
                                 std::int32_t* touching);
    /// find_near() of pair_loop.hpp.
    std::size_t (*find_near)(const double* spheres, std::size_t begin, std::size_t end, const double* centre, std::int32_t* near);
};

/// For any processor: one number at a time.
const Kernels& plain_kernels();
/// The fastest that the processor can run.
const Kernels& fastest_kernels();

}  // namespace coagula::dem::detail
