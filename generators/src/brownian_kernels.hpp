// SPDX-License-Identifier: GPL-3.0-or-later
// The loops over Brownian particles and their neighbours, eight neighbours at a time.
#pragma once

#include "force_table.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace coagula::generators {

struct SlotPair {
    std::int32_t first;
    std::int32_t second;
};

/// The neighbours of the slots `begin` to `end`; each pair stands in the rows of both its particles. Rows are filled up to
/// multiples of eight with the particle itself, which at no distance has no force.
struct NeighbourRows {
    static constexpr std::size_t width = 8;
    std::size_t begin = 0;
    std::size_t end = 0;
    std::vector<std::int32_t> slots;
    std::vector<std::int32_t> owners;  ///< of each group of eight: the slot whose neighbours they are
    std::vector<std::size_t> ends;     ///< of each row, in groups

    void clear(std::size_t first_slot, std::size_t end_slot);
    /// Fills up the next row, whose neighbours were appended to `slots`.
    void close_row();
};

/// What the loops over pairs read. Positions, like forces, have four numbers per slot (x, y, z and one without meaning).
struct PairLoop {
    const double* positions = nullptr;
    const double* radii = nullptr;   ///< null: all are 1
    std::array<double, 3> period{};  ///< of the periodic box
    double lean = 0;                 ///< along x of the third edge of the box
};

/// Sums the forces on the slots of the rows. Pairs meet through the nearest images. For unequal radii the table, which is that of
/// two spheres of radius 1, is scaled with 2 R1 R2/(R1 + R2) (Derjaguin's approximation). The results do not depend on the
/// instructions of the processor, nor on how the slots are shared among rows.
void sum_pair_forces(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, double* forces);

/// The neighbours among `all` that are nearer than `reach`, without radii, or than `reach` plus the two radii.
void choose_neighbours(const PairLoop& loop, double reach, const NeighbourRows& all, NeighbourRows& chosen);

/// Largest squared distance between the places of a slot in two arrays of positions, over the slots from `begin` to `end`.
/// @param strain a shear along x, gradient z, that the other places follow first.
double longest_squared_way(const double* one, const double* other, double strain, std::size_t begin, std::size_t end);

/// Arrays of four numbers per slot, as above, of one stage of a step.
struct StageArrays {
    const double* before;        ///< K_(i-2); in the first stage X, the start of the step
    const double* latest;        ///< K_(i-1), where the forces were taken
    const double* noise;         ///< of the step: independent numbers of variance 1
    const double* second_noise;  ///< the same
    const double* noise_scale;   ///< sqrt(2 kB T mobility dt), one number per slot
    const double* force;         ///< all forces, or those of other origin than the pairs
    const double* mobility;      ///< one number per slot
    double* target;              ///< K_i; may be `before`
};

/// Weights of one stage: target <- force dt mobility F + current K_(i-1) + previous K_(i-2) + noise Q + second_noise R, where Q and
/// R are the two noises times their scale.
struct StageWeights {
    double force = 0;
    double current = 0;
    double previous = 0;
    double noise = 0;
    double second_noise = 0;
};

void stage(const StageArrays& slots, std::size_t begin, std::size_t end, const StageWeights& weights, double time_step);

/// The same for the slots of the rows, with the forces of the pairs added to the others.
void stage_with_pairs(const PairLoop& loop, const ForceTable& table, const NeighbourRows& rows, const StageArrays& slots,
                      const StageWeights& weights, double time_step);

/// Where the first stage takes its forces: latest <- before + evaluation Q.
void displace(const double* before, const double* noise, const double* noise_scale, double evaluation, std::size_t begin,
              std::size_t end, double* latest);

}  // namespace coagula::generators
